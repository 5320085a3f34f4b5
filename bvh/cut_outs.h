// Triangles with holes: whether a ray that meets one is blocked there.
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

#include "bvh/hole_grids.h"
#include "lkao/cut_outs.h"

namespace lkao::bvh {

inline bool has_holes(const CutOuts& cut_outs) { return !cut_outs.opacities.empty() || cut_outs.blocks; }

// Whether it depends on where a ray meets a triangle, not on the ray alone.
inline bool asks_for_places(const CutOuts& cut_outs) { return static_cast<bool>(cut_outs.blocks); }

inline bool has_holes(const CutOuts& cut_outs, std::uint32_t primitive) {
  return cut_outs.opacities.empty() ? static_cast<bool>(cut_outs.blocks) : cut_outs.opacities[primitive] < 1;
}

// The same where the grids are known, which may be of something whole.
inline bool has_holes(const CutOuts& cut_outs, const HoleGrids* grids, std::uint32_t primitive) {
  return has_holes(cut_outs, primitive) && (grids == nullptr || grids->of(primitive) != CutOutPart::opaque);
}

// What tells one ray of one query from all others.
struct RayKey {
  std::uint64_t receiver;  // of (seed, index)
  int ray;
};

// Of the receiver with this index.
std::uint64_t receiver_key(std::uint64_t seed, std::uint64_t index);

// The ray, which meets the triangle, at (u, v) of its corners in the mesh. `grids` of these cut-outs, or null.
bool is_blocked_there(const CutOuts& cut_outs, const HoleGrids* grids, std::uint32_t instance, std::uint32_t primitive,
                      const glm::dvec2& place, const RayKey& key);
// The same where it does not depend on the place.
bool is_blocked_anywhere(const CutOuts& cut_outs, std::uint32_t instance, std::uint32_t primitive, const RayKey& key);

// Throws std::invalid_argument, naming the triangle, where an opacity is not from 0 to 1, or there are not as many
// opacities or looks as triangles; and where there is a survey of what is not asked.
void check(const CutOuts& cut_outs, std::size_t triangle_count);

}  // namespace lkao::bvh
