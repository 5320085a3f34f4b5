// A chain as the methods take it, without the levels that are of no use to them: those that no ray of a query or a
// frame reaches, since they begin at `radius` or beyond it, and those that save too little. The original is always
// there.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "lkao/ambient_occlusion.h"
#include "lod/chain.h"

namespace lkao::lod {

// A level that keeps more than this share of the triangles of the next finer one in use is left out: each level in use
// costs triangles of its own, and so few saved are not worth it.
inline constexpr double kMostKeptShare = 0.75;

// A level in use. Where coarser ones are left out, it stands for their distances too, and the error can only fall.
struct LevelInUse {
  const scene::Mesh* mesh;
  float r_min, r_max;
};

// Those levels; their ranges tile [0, infinity). The chain must outlive them.
std::vector<LevelInUse> levels_in_use(const Chain& chain, float radius);

// Builds a hierarchy for every level in use, for AmbientOcclusion.
std::vector<OccluderLevel> build_levels(const Chain& chain, float radius);

// All levels in use as one mesh, with [r_min, r_max] of each triangle, for gl::MaskPass.
struct RangedMesh {
  scene::Mesh mesh;
  std::vector<glm::vec2> ranges;
};
RangedMesh merge(const Chain& chain, float radius);

}  // namespace lkao::lod
