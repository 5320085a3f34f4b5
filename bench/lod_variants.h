// Chains of levels of one mesh that differ in what they allow.
#pragma once

#include <cstddef>
#include <vector>

#include "lod/chain.h"
#include "scene/mesh.h"

namespace lkao::bench {

// Levels for one k and one epsilon.
struct LodVariant {
  float k = 0, epsilon = 0;  // 0: the mesh itself
  lod::Chain chain;
};

// The mesh itself; then, for each k, `level_count` + 1 levels that begin with a third of the automatic epsilon, and the
// automatic ones.
std::vector<LodVariant> make_lod_variants(const scene::Mesh& mesh, float radius, int level_count,
                                          const std::vector<float>& ks);

// Of the levels in use.
std::size_t triangle_count(const LodVariant& variant, float radius);

}  // namespace lkao::bench
