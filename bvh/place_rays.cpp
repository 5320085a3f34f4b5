#include "bvh/place_rays.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "bvh/bounds.h"
#include "bvh/simd_scene.h"

namespace lkao::bvh {
namespace {

// Lists the open rays, and rays without length up to a whole word of a mask. Returns the length of the longest.
float pick_rays(PlacedRays& placed, float reach) {
  const Query& world = placed.world;
  ReceiverRays& rays = placed.rays;
  int count = 0;
  for_each_ray(world.open, world.rays.word_count(),
               [&](int ray) { placed.numbers[count++] = static_cast<std::uint16_t>(ray); });
  rays.ray_count = count;
  placed.open = first_rays(count);
  const float longest = turn_open_rays(world, reach, rays);
  for (int i = count; i < 64 * word_count_of(count); ++i) rays.x[i] = rays.y[i] = rays.z[i] = 0;
  return longest;
}

void pick_parts(PlacedRays& placed) {
  const RayParts& from = *placed.world.parts;
  for (int i = 0; i < placed.rays.ray_count; ++i) {
    placed.parts.begin[i] = from.begin[placed.numbers[i]];
    placed.parts.end[i] = from.end[placed.numbers[i]];
  }
  for (int i = placed.rays.ray_count; i < 64 * word_count_of(placed.rays.ray_count); ++i) {
    placed.parts.begin[i] = placed.parts.end[i] = 0;
  }
  placed.parts.near = 0.999f * from.near * placed.world.placement->shrink;
  placed.parts.far = placed.rays.radius;
}

// No part of a ray farther than this from its origin can meet the mesh. What is uncertain of all rays grows with the
// longest; parts are shares of whole rays.
float reach_of(const PlacedRays& placed, const Bounds& mesh) {
  if (placed.world.parts != nullptr) return kInfinity;
  const glm::vec3& origin = placed.rays.origin;
  const glm::vec3 farthest = glm::max(glm::abs(mesh.lower - origin), glm::abs(mesh.upper - origin));
  // Corners are not quite where they count, nor is the origin.
  const glm::vec3 off = placed.world.placement->displacement + 0x1p-20f * glm::abs(origin);
  return 1.125f * (glm::length(farthest) + glm::length(off));
}

}  // namespace

glm::vec3 uncertainty(const Placement& placement, const glm::vec3& origin, float radius, const glm::vec3& placed_origin,
                      float placed_radius) {
  glm::vec3 result;
  for (int axis = 0; axis < 3; ++axis) {
    double sum = 0;
    for (int row = 0; row < 3; ++row) {
      const double farthest = std::max(std::fabs(double{placement.box.lower[row]}),  //
                                       std::fabs(double{placement.box.upper[row]}));
      const double size =
          std::fabs(double{origin[row]}) + std::fabs(double{placement.to_world[3][row]}) + farthest + double{radius};
      sum += std::fabs(placement.to_mesh[row][axis]) * size;
    }
    const double rounding = 0x1p-24 * (std::fabs(double{placed_origin[axis]}) + double{placed_radius});
    result[axis] =
        placement.displacement[axis] + std::nextafter(static_cast<float>(rounding + 0x1p-45 * sum), kInfinity);
  }
  return result;
}

bool place_rays(PlacedRays& placed, const Bounds& mesh) {
  const Query& world = placed.world;
  const Placement& placement = *world.placement;
  if (!placement.suits_floats) return false;
  ReceiverRays& rays = placed.rays;
  const glm::dvec3 origin(world.rays.origin);
  rays.origin = glm::vec3(placement.to_mesh * glm::dvec4(origin, 1));
  // Across a plane, vectors go by the transposed matrix.
  const glm::dmat3 linear(placement.to_world[0], placement.to_world[1], placement.to_world[2]);
  rays.up = glm::vec3(glm::normalize(glm::transpose(linear) * glm::dvec3(world.rays.up)));
  rays.frame = glm::mat3(1);
  // A share more than the longest: bounds of rounding that are in proportion to it then cover that of the rays as well.
  rays.radius = 1.125f * pick_rays(placed, reach_of(placed, mesh));
  if (!(rays.radius < 1e18f && rays.radius > 1e-18f) || !(glm::length(rays.origin) < 1e18f)) return false;
  if (world.parts != nullptr) pick_parts(placed);
  const glm::vec3 off = uncertainty(placement, world.rays.origin, world.radius, rays.origin, rays.radius);
  placed.displacement = 1.0001f * glm::length(off);
  placed.face_origins[0] = rays.origin + 1.0001f * off;
  placed.face_origins[1] = rays.origin - 1.0001f * off;
  for (int axis = 0; axis < 3; ++axis) {
    placed.face_origins[0][axis] = std::nextafter(placed.face_origins[0][axis], kInfinity);
    placed.face_origins[1][axis] = std::nextafter(placed.face_origins[1][axis], -kInfinity);
  }
  return true;
}

Query query_of(const PlacedRays& placed) {
  const Query& world = placed.world;
  return {.roots = world.roots,
          .rays = placed.rays,
          .open = placed.open,
          .radius = placed.rays.radius,
          .sidedness = world.sidedness,
          .excluded_primitive = world.excluded_primitive,
          .parts = world.parts != nullptr ? &placed.parts : nullptr,
          .instance = world.instance,
          .key = world.key,
          .placement = world.placement,
          .placed = &placed,
          .face_origins = {placed.face_origins[0], placed.face_origins[1]}};
}

OcclusionMask in_world(const PlacedRays& placed, const OcclusionMask& blocked) {
  OcclusionMask mask;
  for_each_ray(blocked, placed.rays.word_count(), [&](int ray) { mask.set(placed.numbers[ray]); });
  return mask;
}

const PatternCones& cones_of_any_rays() {
  static const PatternCones kCones = [] {
    PatternCones cones;
    std::fill_n(cones.x, PatternCones::kMaxCount, 0.0f);
    std::fill_n(cones.y, PatternCones::kMaxCount, 0.0f);
    std::fill_n(cones.z, PatternCones::kMaxCount, 1.0f);
    std::fill_n(cones.cosine, PatternCones::kMaxCount, -1.0f);
    std::fill_n(cones.sine, PatternCones::kMaxCount, 1.0f);
    return cones;
  }();
  return kCones;
}

}  // namespace lkao::bvh
