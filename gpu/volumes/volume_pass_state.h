// What a VolumePass consists of.
#pragma once

#include <string>
#include <vector>

#include "gpu/frame/g_buffer_check.h"
#include "gpu/frame/target_block.h"
#include "gpu/frame/view_block.h"
#include "gpu/gl/fragment_counters.h"
#include "gpu/gl/objects.h"
#include "gpu/gl/program.h"
#include "gpu/gl/state_keeper.h"
#include "gpu/gl/uniform_buffer.h"
#include "gpu/mesh/mesh_buffers.h"
#include "gpu/mesh/shape_lists.h"
#include "gpu/mesh/shapes_block.h"
#include "gpu/volumes/kept_volumes.h"
#include "gpu/volumes/volume_images.h"
#include "gpu/volumes/volume_pass_block.h"
#include "lkao/gl/volume_pass.h"

namespace lkao::gl {

// What a volume pass touches.
extern const StateUse kVolumesUse;

struct VolumePass::State {
  explicit State(const VolumePassSetup& setup);

  // The steps of a frame, in their order.
  void make_images(const GBuffer& g_buffer);
  void wait_for_last_frame() const;
  void describe(const MeshBuffers& mesh, const GBuffer& g_buffer, const Camera& camera, const RayOptions& options,
                const VolumeOptions& volumes);
  void bind_inputs(const GBuffer& g_buffer) const;
  void check_inputs(const GBuffer& g_buffer, const RayOptions& options);
  void find_volumes(const MeshBuffers& mesh);
  void draw_receivers() const;
  void draw_volumes(const MeshBuffers& mesh, const Camera& camera);
  void resolve(const OcclusionTarget& to) const;

  VolumePassSetup setup;  // nothing in it is automatic
  ShapeLists lists;
  KeptVolumes kept;
  VolumeImages images;
  GBufferCheck check;

  // Of the last draw().
  bool is_drawn = false;
  std::vector<std::string> warnings;
  ViewBlock view{};
  ShapesBlock shapes{};
  VolumePassBlock block{};

  UniformBuffer<ViewBlock> view_buffer;
  UniformBuffer<ShapesBlock> shapes_buffer;
  UniformBuffer<VolumePassBlock> block_buffer;
  UniformBuffer<TargetBlock> target_buffer;
  FragmentCounters counters;
  Sampler plain_sampler;
  VertexArray no_attributes;
  ProgramObject classify, extend, receivers, resolve_program;
  ProgramObject volumes[2];  // with one horizon, with two
};

}  // namespace lkao::gl
