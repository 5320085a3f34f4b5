// What most tests of the pass look at, and the comparison with the CPU.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "gpu/g_buffer_pass.h"
#include "lkao/ambient_occlusion.h"
#include "lkao/gl.h"
#include "support/meshes.h"

namespace lkao::gl::tests {

// A room, seen from within: large quads, a ball of small triangles, a few hundred triangles of all sizes in the air.
Mesh furnished_room();
Camera room_camera(int width, int height);

inline Sidedness sidedness_of(bool two_sided) { return two_sided ? Sidedness::two_sided : Sidedness::one_sided; }

// All pixels' masks as the CPU finds them, SamplePattern::word_count() words each.
std::vector<std::uint64_t> cpu_masks(const Mesh& mesh, const std::vector<Receiver>& receivers,
                                     const SamplePattern& pattern, const RayOptions& options);

// In how many rays two sets of masks differ.
std::uint64_t count_differences(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b);
std::uint64_t count_bits(const std::vector<std::uint64_t>& masks);
// The share of pixels whose masks are the same in all bits.
double share_of_equal_pixels(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b, int word_count);

// A pass and what it draws.
struct PassOnMesh : MaskPass {
  explicit PassOnMesh(const MaskPassSetup& setup = {}) : MaskPass(setup) {}
  // Rays start where those of the query do, so that masks can be the same.
  void draw(const GBuffer& g_buffer, const Camera& camera, RayOptions options, const RasterOptions& raster = {}) {
    if (options.surface_offset == kAutomaticSurfaceOffset) options.surface_offset = kQuerySurfaceOffset;
    draw_off_surface(g_buffer, camera, options, raster);
  }
  // As farther off as an automatic offset takes them.
  void draw_off_surface(const GBuffer& g_buffer, const Camera& camera, const RayOptions& options,
                        const RasterOptions& raster = {}) {
    MaskPass::draw(occluders, g_buffer, camera, options, raster);
  }

  Occluders occluders;
};

// With mesh and table, ready to draw.
PassOnMesh make_pass(const Mesh& mesh, const PlaneMaskTable& table, const MaskPassSetup& setup = {});

}  // namespace lkao::gl::tests
