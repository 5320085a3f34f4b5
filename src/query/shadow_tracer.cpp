#include "query/shadow_tracer.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "bvh/cut_outs.h"
#include "lut/random.h"
#include "query/shadow_answer.h"

namespace lkao::query {
namespace {

float largest_of(const glm::vec3& v) { return std::max(std::fabs(v.x), std::max(std::fabs(v.y), std::fabs(v.z))); }

Bounds bounds_of(const SphereLight& light) {
  return {light.position - glm::vec3(light.radius), light.position + glm::vec3(light.radius)};
}

Bounds bounds_of(const DiscLight& light) {
  const glm::dvec3 n = glm::normalize(glm::dvec3(light.normal));
  const glm::vec3 size = static_cast<double>(light.radius) * glm::sqrt(glm::max(1.0 - n * n, 0.0));
  return {light.position - size, light.position + size};
}

Bounds bounds_of(const AreaLight& light) {
  return std::visit([](const auto& one) { return bounds_of(one); }, light);
}

float largest_of(const Bounds& box) { return std::max(largest_of(box.lower), largest_of(box.upper)); }

// All points of the disk, whatever the lengths of the pattern's rays.
PatternLanes disk_of(const SamplePattern& pattern) {
  PatternLanes lanes(pattern);
  std::fill_n(lanes.length.begin(), pattern.ray_count(), 1.0f);
  return lanes;
}

}  // namespace

ShadowTracer::ShadowTracer(OccluderScene occluders, const AreaLight& light, SamplePattern pattern,
                           const ShadowOptions& options, Kernel kernel)
    : bundles_(std::move(occluders), options.sidedness, kernel),
      light_(light),
      pattern_(std::move(pattern)),
      options_(options),
      ray_options_{.radius = 1, .surface_offset = options.surface_offset},
      disk_(disk_of(pattern_)),
      largest_coordinate_(bundles_.occluders().occluder_count() > 0 ? largest_of(bundles_.occluders().bounds()) : 0),
      largest_at_light_(std::max(largest_coordinate_, largest_of(bounds_of(light)))) {}

bool ShadowTracer::make_rays(const Receiver& receiver, std::uint64_t index, ReceiverRays& rays) const {
  rays.cast = OcclusionMask();
  rays.ray_count = pattern_.ray_count();
  rays.origin = receiver.position;
  rays.radius = 0;
  if (!is_valid(receiver)) return false;
  const float offset = offset_of(receiver.position, ray_options_, largest_coordinate_);
  rays.up = geometric_normal(receiver);
  rays.origin = receiver.position + rays.up * offset;

  lut::RandomStream random(lut::mix_bits(options_.seed) ^ index);
  SeenLight seen;
  const double turn = random.next_double() * static_cast<double>(options_.rotation);
  if (!see(light_, rays.origin, turn, seen)) return false;
  rays.frame = seen.frame;
  rays.radius = seen.distance + seen.radius;
  const float end_offset = offset_of(receiver.position, ray_options_, largest_at_light_);
  const float reach = std::max(seen.distance, seen.radius);
  aim_at_light(disk_, seen, std::max(0.0f, 1 - end_offset / reach), rays);
  return true;
}

// Around all points of the light, rounding included.
Bounds ShadowTracer::ends() const {
  const Bounds exact = bounds_of(light_);
  const glm::vec3 margin(0x1p-20f * largest_at_light_);
  return {exact.lower - margin, exact.upper + margin};
}

ShadowTracer::Visit::Visit(const ShadowTracer& tracer, const Bounds& positions)
    : tracer_(tracer),
      bundles_(tracer.bundles_, bounds_of_origins(positions, tracer.ray_options_, tracer.largest_coordinate_),
               tracer.ends()) {}

LightVisibility ShadowTracer::Visit::trace(const Receiver& receiver, std::uint64_t index, ReceiverRays& rays) {
  if (!tracer_.make_rays(receiver, index, rays)) return make_shadow_answer(false, rays, {});
  const float radius = rays.radius;
  const glm::vec3 up = rays.up;
  const glm::mat3 frame = rays.frame;
  const OcclusionMask blocked = bundles_.trace(receiver, bvh::receiver_key(tracer_.options_.seed, index), rays);
  rays.radius = radius;
  rays.up = up;
  rays.frame = frame;
  return make_shadow_answer(true, rays, blocked);
}

}  // namespace lkao::query
