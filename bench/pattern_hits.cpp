#include "bench/pattern_hits.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "lut/ray_options.h"

namespace lkao::bench {
namespace {

constexpr std::size_t kLaneCount = 16;

float largest_coordinate(const scene::Mesh& mesh) {
  float largest = 0;
  for (const glm::vec3& position : mesh.positions) {
    const glm::vec3 size = glm::abs(position);
    largest = std::max({largest, size.x, size.y, size.z});
  }
  return largest;
}

}  // namespace

FirstHits::FirstHits(const scene::Mesh& mesh, float radius)
    : scene_(mesh.view(), true),
      radius_(radius),
      surface_offset_(lut::relative_surface_offset({}) * largest_coordinate(mesh)) {}

void FirstHits::find(const Receiver& receiver, const glm::mat3& frame, std::span<const glm::vec3> directions,
                     std::span<float> distances) const {
  const glm::vec3 origin = receiver.position + surface_offset_ * glm::normalize(receiver.normal);
  scene::embree::RayQuery query;
  for (std::size_t first = 0; first < directions.size(); first += kLaneCount) {
    const std::size_t count = std::min(kLaneCount, directions.size() - first);
    RTCRayHit16 rays;
    alignas(64) int valid[kLaneCount] = {};
    for (std::size_t lane = 0; lane < count; ++lane) {
      const glm::vec3 ray = radius_ * (frame * directions[first + lane]);
      valid[lane] = -1;
      rays.ray.org_x[lane] = origin.x, rays.ray.org_y[lane] = origin.y, rays.ray.org_z[lane] = origin.z;
      rays.ray.dir_x[lane] = ray.x, rays.ray.dir_y[lane] = ray.y, rays.ray.dir_z[lane] = ray.z;
      rays.ray.tnear[lane] = 0, rays.ray.tfar[lane] = 1, rays.ray.time[lane] = 0;
      rays.ray.mask[lane] = ~0u, rays.ray.id[lane] = 0, rays.ray.flags[lane] = 0;
      rays.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    }
    intersect(scene_.plain(), query, valid, rays);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const bool hit = rays.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
      distances[first + lane] = hit ? rays.ray.tfar[lane] : std::numeric_limits<float>::infinity();
    }
  }
}

}  // namespace lkao::bench
