// What a MaskPass consists of.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gpu/frame/g_buffer_check.h"
#include "gpu/frame/target_block.h"
#include "gpu/frame/view_block.h"
#include "gpu/gl/fragment_counters.h"
#include "gpu/gl/objects.h"
#include "gpu/gl/state_keeper.h"
#include "gpu/gl/uniform_buffer.h"
#include "gpu/masks/mask_images.h"
#include "gpu/masks/mask_pass_block.h"
#include "gpu/masks/table_buffer.h"
#include "gpu/mesh/mesh_buffers.h"
#include "gpu/mesh/shape_lists.h"
#include "gpu/mesh/shapes.h"
#include "gpu/mesh/unbounded_radius.h"
#include "lkao/gl/mask_pass.h"

namespace lkao::gl {

// What a mask pass touches while it draws, and while it resolves or reads.
extern const StateUse kDrawUse, kResolveUse, kReadUse;

struct MaskPass::State {
  explicit State(const MaskPassSetup& setup);

  void set_table(const PlaneMaskTable& table);

  // The steps of a frame, in their order.
  void make_images(int width, int height);
  void wait_for_last_frame() const;
  void describe(const MeshBuffers& mesh, const GBuffer& g_buffer, const Camera& camera, const RayOptions& options,
                const RasterOptions& raster);
  void bind_inputs(const GBuffer& g_buffer) const;
  void check_inputs(const GBuffer& g_buffer, const RayOptions& options);
  void classify_occluders(const MeshBuffers& mesh);
  void find_receivers();
  // Only for an infinite radius: finds one that stands for it, and classifies the occluders again.
  void find_radius(const MeshBuffers& mesh);
  void draw_depths();
  void draw_shapes(const MeshBuffers& mesh, const Camera& camera);
  void drop_rays_not_cast();

  void write_targets(const ResolveTargets& written);

  void bind_blocks() const;
  // Throws where there is nothing to resolve or read.
  void require_drawn() const;

  MaskPassSetup setup;  // nothing in it is automatic
  std::optional<TableBuffer> table;
  ShapePrograms programs;  // for the table
  ShapeLists shapes;
  UnboundedRadius unbounded_radius;
  MaskImages images;
  GBufferCheck check;

  // Of the last draw().
  bool is_drawn = false;
  std::vector<std::string> warnings;
  ViewBlock view{};
  ShapesBlock shapes_block{};
  MaskPassBlock block{};

  UniformBuffer<ViewBlock> view_buffer;
  UniformBuffer<ShapesBlock> shapes_buffer;
  UniformBuffer<MaskPassBlock> block_buffer;
  UniformBuffer<TargetBlock> target_buffer;
  FragmentCounters counters;
  Sampler plain_sampler;
  VertexArray no_attributes;
  ProgramObject classify, receivers, depth, cast, resolve;
};

}  // namespace lkao::gl
