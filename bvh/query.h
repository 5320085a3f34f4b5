// What a receiver asks of a hierarchy, and the definition of the answer for one of its rays and a triangle.
#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "bvh/blocker_memory.h"
#include "bvh/layout.h"
#include "bvh/ray_parts.h"
#include "bvh/ray_triangle.h"
#include "lkao/receiver.h"
#include "lkao/receiver_rays.h"

namespace lkao::bvh {

// What a receiver asks of the hierarchy.
struct Query {
  std::span<const Node> roots;  // where to begin: layout.root(), or entry nodes for the origin of the rays
  const ReceiverRays& rays;
  const OcclusionMask& open;  // rays to decide about: rays.cast or fewer
  float radius = 0;
  Sidedness sidedness = Sidedness::two_sided;
  std::uint32_t excluded_primitive = kNoPrimitive;
  const RayParts* parts = nullptr;  // null: whole rays
  BlockerMemory* memory = nullptr;  // of this layout; null: none

  // Where rays begin and end to count, at the earliest and latest.
  float near() const { return parts != nullptr ? parts->near : 0; }
  float far() const { return parts != nullptr ? parts->far : radius; }
};

// The definition for one triangle as the query's receiver sees it.
inline TriangleTest make_test(const Layout& layout, std::uint32_t primitive, const Query& query) {
  return {layout.mesh.corner(primitive, 0),
          layout.mesh.corner(primitive, 1),
          layout.mesh.corner(primitive, 2),
          query.rays.origin,
          query.radius,
          query.sidedness};
}

// The definition for one ray of the query.
inline bool blocks(const TriangleTest& test, const Query& query, int ray) {
  if (query.parts == nullptr) return test.blocks(query.rays.ray(ray));
  return test.blocks(query.rays.ray(ray), query.parts->begin[ray], query.parts->end[ray]);
}

// Calls `function(ray)` for every ray of the mask.
template <typename Function>
void for_each_ray(const OcclusionMask& mask, int word_count, const Function& function) {
  for (int word = 0; word < word_count; ++word) {
    for (std::uint64_t bits = mask.words[word]; bits != 0; bits &= bits - 1) {
      function(word * 64 + std::countr_zero(bits));
    }
  }
}

}  // namespace lkao::bvh
