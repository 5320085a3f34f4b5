#include "lkao/ray_bundles.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "bvh/query.h"
#include "lut/coordinates.h"
#include "lut/isa.h"
#include "query/batch.h"
#include "query/bundle_tracer.h"

namespace lkao {
namespace {

// Components up to this make rays no longer than the longest AO radius.
constexpr float kLongestComponent = 5e17f;

bool is_in_reach(const glm::vec3& ray) {
  return std::fabs(ray.x) <= kLongestComponent && std::fabs(ray.y) <= kLongestComponent &&
         std::fabs(ray.z) <= kLongestComponent;
}

void check(const glm::vec3& origin, std::span<const glm::vec3> bundle) {
  if (bundle.size() < kMinRayCount || bundle.size() > kMaxRayCount) {
    throw std::invalid_argument(
        fmt::format("rays must be from {} to {}, not {}", kMinRayCount, kMaxRayCount, bundle.size()));
  }
  if (!lut::is_in_range(origin)) {
    throw std::invalid_argument(
        fmt::format("origin must be within 1e18, not ({}, {}, {})", origin.x, origin.y, origin.z));
  }
  for (std::size_t i = 0; i < bundle.size(); ++i) {
    const glm::vec3& ray = bundle[i];
    if (is_in_reach(ray)) continue;
    throw std::invalid_argument(fmt::format("rays[{}] must be within 5e17, not ({}, {}, {})", i, ray.x, ray.y, ray.z));
  }
}

// As kernels see them.
void lay_out(const glm::vec3& origin, std::span<const glm::vec3> bundle, ReceiverRays& rays) {
  rays.origin = origin;
  rays.ray_count = static_cast<int>(bundle.size());
  rays.cast = bvh::first_rays(rays.ray_count);
  for (int i = 0; i < rays.ray_count; ++i) {
    const glm::vec3& ray = bundle[static_cast<std::size_t>(i)];
    rays.x[i] = ray.x;
    rays.y[i] = ray.y;
    rays.z[i] = ray.z;
  }
  const int lane_count = rays.word_count() * 64;
  for (int i = rays.ray_count; i < lane_count; ++i) rays.x[i] = rays.y[i] = rays.z[i] = 0;
}

OcclusionMask trace(query::BundleTracer::Visit& visit, const RayBundle& bundle, ReceiverRays& rays) {
  check(bundle.origin, bundle.rays);
  lay_out(bundle.origin, bundle.rays, rays);
  return visit.trace({.excluded_primitive = bundle.excluded_primitive,
                      .excluded_instance = bundle.excluded_instance,
                      .occluder_groups = bundle.occluder_groups},
                     bvh::receiver_key(0, bundle.index), rays);
}

}  // namespace

RayBundles::RayBundles(OccluderScene occluders, Sidedness sidedness, Kernel kernel) {
  lut::obey_isa_environment();
  tracer_ = std::make_shared<query::BundleTracer>(std::move(occluders), sidedness, kernel);
}

OcclusionMask RayBundles::blocked(const glm::vec3& origin, std::span<const glm::vec3> rays,
                                  std::uint32_t excluded_primitive) const {
  query::BundleTracer::Visit visit(*tracer_);
  ReceiverRays laid_out;
  return trace(visit, {.origin = origin, .rays = rays, .excluded_primitive = excluded_primitive}, laid_out);
}

void RayBundles::blocked(std::span<const RayBundle> bundles, std::span<OcclusionMask> masks,
                         const Progress& progress) const {
  if (masks.size() != bundles.size()) {
    throw std::invalid_argument(fmt::format("masks has {} entries, not {}", masks.size(), bundles.size()));
  }
  query::answer_in_parts(bundles.size(), progress, [&](std::size_t first, std::size_t last) {
    query::BundleTracer::Visit visit(*tracer_);
    ReceiverRays laid_out;
    for (std::size_t k = first; k < last; ++k) masks[k] = trace(visit, bundles[k], laid_out);
    return QueryReport{};
  });
}

const OccluderScene& RayBundles::occluders() const { return tracer_->occluders(); }
Sidedness RayBundles::sidedness() const { return tracer_->sidedness(); }

}  // namespace lkao
