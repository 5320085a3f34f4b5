// What a texture is baked of, and how.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "scene/contents.h"

namespace lkao::bake {

class Cage;

inline constexpr int kMaxTextureSize = 32768;  // texels each way
inline constexpr int kMaxTextureGrid = 16;

// What is shown at texture coordinates outside of [0, 1]. Beyond a clamped edge nothing is baked, and counted.
using Wrap = scene::TextureWrap;

enum class BentNormals {
  none,
  object,   // in the space of the positions
  tangent,  // in that of a tangent-space normal map (tangent_frames.h)
};

struct TextureOptions {
  int width = 1024, height = 1024;
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
  // A map for each unit square of texture coordinates that triangles reach, by its UDIM number, 1001 + u + 10 v with v
  // upwards; instead of wrapping.
  bool udim = false;
  std::optional<std::uint32_t> material = {};  // only triangles of this one
  // A texel that lies wholly in one triangle has grid x grid samples. Of others, each triangle's part has one in each
  // of edge_grid x edge_grid cells of the texel that it touches, for its area.
  int grid = 1, edge_grid = 2;
  BentNormals bent_normals = BentNormals::none;
  // Occlusion is that of the detailed mesh around which the cage is; outlives the bake. Null: of the mesh itself.
  const Cage* cage = nullptr;
  bool inwards = false;     // rays into the body, for its thickness
  bool level_seams = true;  // texture_seams.h
  // Texels by which charts grow (padding.h), at least 2 where seams are levelled; none: usual_margin().
  std::optional<int> margin = {};
};

// Throws std::invalid_argument naming the option and its value.
void check(const TextureOptions& options);

// A whole texel of the chart's own beside it in each level of the mip chain down to 64 x 64 texels.
int usual_margin(const TextureOptions& options);

// What was seen on the way. Counts of triangles are of the material's.
struct TextureReport {
  std::size_t triangle_count = 0;
  std::size_t bare_triangle_count = 0;      // without (finite) texture coordinates: not baked
  std::size_t flat_triangle_count = 0;      // without area, in space or in the texture: not baked
  std::size_t mirrored_triangle_count = 0;  // baked; the texture shows them the wrong way round
  std::size_t outside_triangle_count = 0;   // baked but for parts beyond a clamped edge, or beyond all UDIM tiles
  std::size_t wide_triangle_count = 0;      // over more than 64 repeats: only the first 64 are baked
  std::size_t texel_count = 0;              // of all maps
  std::size_t covered_texel_count = 0;      // touched by triangles
  // Wanted by several places of the surface at once. The chart whose first triangle comes first has the texel; within
  // one chart, the triangle that comes first.
  std::size_t overlapping_texel_count = 0;
  std::size_t receiver_count = 0;
  std::size_t missed_receiver_count = 0;  // of these, from which a cage's ray met nothing: they are on the mesh itself
  std::size_t empty_texel_count = 0;      // covered, but no receiver there is valid: filled from around
  // Edges of the surface where the texture is cut, and by how much both sides differ there at most, before they were
  // levelled and after. Of a bake in parts, only finish_texture() knows them.
  std::size_t seam_count = 0;
  double worst_seam_before = 0, worst_seam_after = 0;
};

}  // namespace lkao::bake
