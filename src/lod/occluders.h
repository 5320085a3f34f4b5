// A chain as the methods take it, without the levels that no ray of a query or a frame reaches: those that begin at
// `radius` or beyond it. The original is always there.
#pragma once

#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "lkao/ambient_occlusion.h"
#include "lod/chain.h"

namespace lkao::lod {

// Those levels.
std::span<const Level> levels_within(const Chain& chain, float radius);

// Builds a hierarchy for every level, for AmbientOcclusion.
std::vector<OccluderLevel> build_levels(const Chain& chain, float radius);

// All levels as one mesh, with [r_min, r_max] of each triangle, for gl::OcclusionPass.
struct RangedMesh {
  scene::Mesh mesh;
  std::vector<glm::vec2> ranges;
};
RangedMesh merge(const Chain& chain, float radius);

}  // namespace lkao::lod
