// What a receiver asks of a hierarchy, and the definition of the answer for one of its rays and a triangle.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include "bvh/blocker_memory.h"
#include "bvh/cut_outs.h"
#include "bvh/layout.h"
#include "bvh/placement.h"
#include "bvh/ray_parts.h"
#include "bvh/ray_triangle.h"
#include "lkao/receiver.h"
#include "lkao/receiver_rays.h"

namespace lkao::bvh {

struct PlacedRays;

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
  // Of a scene: whose primitive is excluded, and what may block.
  std::uint32_t excluded_instance = 0;
  std::uint32_t groups = kAllGroups;
  std::uint32_t instance = 0;  // the mesh's own number in it
  std::uint64_t key = 0;       // receiver_key, for triangles with holes
  // Where the mesh stands; null: in the world, as its positions say.
  const Placement* placement = nullptr;
  // Of a mesh that stands somewhere: the rays are these, in its own space. Null: rays are in the world.
  const PlacedRays* placed = nullptr;
  // What is taken from the lower and from the upper faces of boxes: where the origin is, at least and at most.
  glm::vec3 face_origins[2] = {rays.origin, rays.origin};

  // Where rays begin and end to count, at the earliest and latest.
  float near() const { return parts != nullptr ? parts->near : 0; }
  float far() const { return parts != nullptr ? parts->far : radius; }
};

// The rays of a query in the space of a mesh that stands somewhere in the world: those that are open, one behind the
// other, rounded to float. They tell which triangles a ray may meet; whether it does is decided in the world.
struct PlacedRays {
  explicit PlacedRays(const Query& in_world) : world(in_world) {}

  const Query& world;
  ReceiverRays rays;
  OcclusionMask open;                        // all of them
  std::uint16_t numbers[kMaxRayCount + 16];  // in the world's query
  RayParts parts;                            // where it has some
  glm::vec3 face_origins[2];                 // Query::face_origins
  // No corner is farther from where it counts than this, the rounding of the origin included.
  float displacement;
};

// Corners as they count: in the world, counter-clockwise where the mesh's are.
inline Corners corners_of(const Layout& layout, std::uint32_t primitive, const Query& query) {
  const Corners own = layout.mesh.corners(primitive);
  if (query.placement == nullptr) return own;
  const glm::mat4x3& to_world = query.placement->to_world;
  const Corners placed{place(to_world, own.a), place(to_world, own.b), place(to_world, own.c)};
  return query.placement->is_mirrored ? Corners{placed.a, placed.c, placed.b} : placed;
}

// The definition for one triangle as the query's receiver sees it.
inline TriangleTest make_test(const Layout& layout, std::uint32_t primitive, const Query& query) {
  const Query& world = query.placed != nullptr ? query.placed->world : query;
  const Corners corners = corners_of(layout, primitive, query);
  return {corners.a, corners.b, corners.c, world.rays.origin, world.radius, query.sidedness};
}

inline bool has_holes(const Layout& layout, std::uint32_t primitive) {
  return has_holes(layout.options.cut_outs, layout.grids.get(), primitive);
}

// The number of the query's ray in the world.
inline int number_in_world(const Query& query, int ray) {
  return query.placed != nullptr ? query.placed->numbers[ray] : ray;
}

// The definition for one ray of the query that meets the triangle with holes that the test was made of.
inline bool blocks_where_met(const TriangleTest& test, const Layout& layout, std::uint32_t primitive,
                             const Query& query, int ray) {
  const Query& world = query.placed != nullptr ? query.placed->world : query;
  const int number = number_in_world(query, ray);
  const glm::dvec2 place = test.place(world.rays.ray(number));
  const bool is_mirrored = query.placement != nullptr && query.placement->is_mirrored;
  return is_blocked_there(layout.options.cut_outs, layout.grids.get(), query.instance, primitive,
                          is_mirrored ? glm::dvec2(place.y, place.x) : place, {query.key, number});
}

// The definition for one ray of the query and the triangle that the test was made of.
inline bool blocks(const TriangleTest& test, const Layout& layout, std::uint32_t primitive, const Query& query,
                   int ray) {
  const Query& world = query.placed != nullptr ? query.placed->world : query;
  const int number = number_in_world(query, ray);
  const glm::vec3 segment = world.rays.ray(number);
  const bool meets = world.parts == nullptr
                         ? test.blocks(segment)
                         : test.blocks(segment, world.parts->begin[number], world.parts->end[number]);
  return meets && (!has_holes(layout, primitive) || blocks_where_met(test, layout, primitive, query, ray));
}

// Rays 0 to count - 1.
inline OcclusionMask first_rays(int count) {
  OcclusionMask mask;
  for (int word = 0; 64 * word < count; ++word) {
    mask.words[word] = ~std::uint64_t{0} >> (64 - std::min(64, count - 64 * word));
  }
  return mask;
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
