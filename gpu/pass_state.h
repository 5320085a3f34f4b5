// What an OcclusionPass consists of.
#pragma once

#include <optional>

#include "gpu/gl_objects.h"
#include "gpu/occluders.h"
#include "gpu/pass_uniforms.h"
#include "gpu/shapes.h"
#include "gpu/table_buffer.h"
#include "gpu/targets.h"
#include "gpu/unbounded_radius.h"
#include "lkao/gl.h"

namespace lkao::gl {

struct OcclusionPass::State {
  explicit State(const PassSetup& setup);

  // The steps of a frame, in their order.
  void wait_for_last_frame() const;
  void set_uniforms(const GBuffer& g_buffer, const Camera& camera, const RayOptions& options,
                    const RasterOptions& raster);
  void classify_occluders();
  void find_receivers();
  // Only for an infinite radius: finds one that stands for it, and classifies the occluders again.
  void find_radius();
  void draw_depths();
  void draw_shapes(const Camera& camera);
  void drop_rays_not_cast();

  void bind_uniforms() const;
  // 8 x 8 pixels a group.
  void dispatch_over_pixels() const;
  // Throws where there is nothing to resolve or read.
  void require_drawn() const;

  PassSetup setup;  // nothing in it is automatic
  Occluders occluders;
  UnboundedRadius unbounded_radius;
  std::optional<TableBuffer> table;
  Targets targets;
  PassUniforms uniforms;  // of the last draw()
  bool is_drawn = false;

  Buffer uniform_buffer, counters;
  Sampler sampler;
  VertexArray no_attributes;
  ProgramObject classify, receivers, depth, cast, resolve;
  ShapePrograms shapes;  // for the table
};

}  // namespace lkao::gl
