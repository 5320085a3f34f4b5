#include "query/receiver_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lut/coordinates.h"
#include "lut/random.h"
#include "lut/ray_options.h"
#include "query/turn_pattern.h"

namespace lkao::query {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr Bounds kNowhere{glm::vec3(kInfinity), glm::vec3(-kInfinity)};

// Normals may have any length: the arithmetic is in double, where no float overflows.
bool is_direction(const glm::vec3& v) { return lut::is_finite(v) && v != glm::vec3(0); }

glm::dvec3 unit(const glm::vec3& v) { return glm::normalize(glm::dvec3(v)); }

// Tangents that turn smoothly with the normal but for one seam (T. Duff et al., "Building an Orthonormal Basis,
// Revisited", JCGT 6(1), 2017).
void make_tangents(const glm::dvec3& n, glm::dvec3& tangent, glm::dvec3& bitangent) {
  const double sign = std::copysign(1.0, n.z);
  const double a = -1.0 / (sign + n.z);
  const double b = n.x * n.y * a;
  tangent = {1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x};
  bitangent = {b, sign + n.y * n.y * a, -n.y};
}

glm::mat3 turned_frame(const glm::dvec3& tangent, const glm::dvec3& bitangent, const glm::dvec3& axis, double turn) {
  const double cosine = std::cos(turn), sine = std::sin(turn);
  return glm::mat3(cosine * tangent + sine * bitangent, cosine * bitangent - sine * tangent, axis);
}

float largest_component(const glm::vec3& v) {
  return std::max(std::fabs(v.x), std::max(std::fabs(v.y), std::fabs(v.z)));
}

}  // namespace

float offset_of(const glm::vec3& position, const RayOptions& options, float largest_coordinate) {
  return lut::relative_surface_offset(options) * std::max(largest_component(position), largest_coordinate);
}

bool is_valid(const Receiver& receiver) {
  return lut::is_in_range(receiver.position) && is_direction(receiver.normal) &&
         (receiver.geometric_normal == glm::vec3(0) || is_direction(receiver.geometric_normal));
}

glm::vec3 geometric_normal(const Receiver& receiver) {
  return unit(receiver.geometric_normal == glm::vec3(0) ? receiver.normal : receiver.geometric_normal);
}

glm::mat3 jittered_frame(const Receiver& receiver, const Jitter& jitter, float lowest_elevation, std::uint64_t seed,
                         std::uint64_t index) {
  lut::RandomStream random(lut::mix_bits(seed) ^ index);
  const double turn = random.next_double() * jitter.rotation * 2.0 * std::numbers::pi;
  // Evenly over the disk of tilts.
  const double tilt = lut::largest_tilt(jitter, lowest_elevation) * std::sqrt(random.next_double());
  const double tilt_turn = random.next_double() * 2.0 * std::numbers::pi;

  const glm::dvec3 normal = unit(receiver.normal);
  glm::dvec3 tangent, bitangent;
  make_tangents(normal, tangent, bitangent);
  glm::dvec3 axis = normal;
  if (tilt > 0) {
    const glm::dvec3 sideways = std::cos(tilt_turn) * tangent + std::sin(tilt_turn) * bitangent;
    axis = glm::normalize(std::cos(tilt) * normal + std::sin(tilt) * sideways);
    make_tangents(axis, tangent, bitangent);
  }
  return turned_frame(tangent, bitangent, axis, turn);
}

glm::mat3 frame_around(const glm::dvec3& axis, double turn) {
  glm::dvec3 tangent, bitangent;
  make_tangents(axis, tangent, bitangent);
  return turned_frame(tangent, bitangent, axis, 2.0 * std::numbers::pi * turn);
}

OccluderExtent extent_of(std::span<const Level> levels) {
  OccluderExtent extent{kNowhere, 0};
  for (const Level& level : levels) {
    const Bounds& bounds = level.occluders.bounds();
    extent.bounds = {glm::min(extent.bounds.lower, bounds.lower), glm::max(extent.bounds.upper, bounds.upper)};
  }
  if (const Bounds& bounds = levels.front().occluders.bounds(); bounds.lower.x <= bounds.upper.x) {
    extent.largest_coordinate = std::max(largest_component(bounds.lower), largest_component(bounds.upper));
  }
  return extent;
}

PatternLanes::PatternLanes(const SamplePattern& pattern, bool is_unbounded)
    : length(pattern.lengths().begin(), pattern.lengths().end()),
      ray_count(pattern.ray_count()),
      lowest_elevation(pattern.lowest_elevation()) {
  for (const glm::vec3& direction : pattern.directions()) {
    x.push_back(direction.x);
    y.push_back(direction.y);
    z.push_back(direction.z);
  }
  if (is_unbounded) {
    for (float& share : length) share = share > 0 ? 1.0f : 0.0f;
  }
  const auto padded_count = static_cast<std::size_t>(pattern.word_count()) * 64;
  for (std::vector<float>* lanes : {&x, &y, &z, &length}) lanes->resize(padded_count);
}

Bounds bounds_of(std::span<const Receiver> receivers) {
  Bounds bounds = kNowhere;
  for (const Receiver& receiver : receivers) {
    if (!lut::is_in_range(receiver.position)) continue;
    bounds.lower = glm::min(bounds.lower, receiver.position);
    bounds.upper = glm::max(bounds.upper, receiver.position);
  }
  return bounds;
}

Bounds bounds_of_origins(const Bounds& positions, const RayOptions& options, float largest_coordinate) {
  if (!(positions.lower.x <= positions.upper.x)) return kNowhere;
  const glm::vec3 farthest = glm::max(glm::abs(positions.lower), glm::abs(positions.upper));
  // Twice the offset: rounding included.
  const glm::vec3 offset(2 * offset_of(farthest, options, largest_coordinate));
  return {positions.lower - offset, positions.upper + offset};
}

float radius_beyond(const Bounds& occluders, const glm::vec3& origin) {
  if (!(occluders.lower.x <= occluders.upper.x)) return 1;
  const glm::dvec3 from(origin);
  const glm::dvec3 farthest = glm::max(glm::abs(glm::dvec3(occluders.lower) - from),  //
                                       glm::abs(glm::dvec3(occluders.upper) - from));
  // The length of a direction in float, and of what is made of it, is off by far less than this.
  const double distance = 1.001 * glm::length(farthest);
  return static_cast<float>(std::exp2(std::ceil(std::log2(distance))));
}

void make_rays(const Receiver& receiver, const PatternLanes& pattern, const RayOptions& options,
               const OccluderExtent& occluders, std::uint64_t index, ReceiverRays& rays) {
  rays.cast = OcclusionMask();
  rays.ray_count = pattern.ray_count;
  rays.origin = receiver.position;
  rays.radius = options.radius;
  if (!is_valid(receiver)) return;

  rays.up = geometric_normal(receiver);
  rays.origin = receiver.position + rays.up * offset_of(receiver.position, options, occluders.largest_coordinate);
  if (std::isinf(options.radius)) rays.radius = radius_beyond(occluders.bounds, rays.origin);

  rays.frame = jittered_frame(receiver, options.jitter, pattern.lowest_elevation, options.seed, index);
  turn_pattern(pattern, rays.frame, rays.radius, rays.up, rays);
}

}  // namespace lkao::query
