#include "lkao/soft_shadows.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "lut/coordinates.h"
#include "lut/isa.h"
#include "lut/ray_options.h"
#include "lut/require.h"
#include "query/batch.h"
#include "query/shadow_answer.h"
#include "query/shadow_tracer.h"

namespace lkao {
namespace {

constexpr float kFarthestLight = 1e17f;

void check(const char* name, const glm::vec3& position, float radius) {
  if (!(std::fabs(position.x) <= kFarthestLight && std::fabs(position.y) <= kFarthestLight &&
        std::fabs(position.z) <= kFarthestLight)) {
    throw std::invalid_argument(
        fmt::format("{}.position must be within 1e17, not ({}, {}, {})", name, position.x, position.y, position.z));
  }
  if (!(radius > 0 && radius <= kFarthestLight)) {
    throw std::invalid_argument(fmt::format("{}.radius must be greater than 0 and at most 1e17, not {}", name, radius));
  }
}

void check(const DiscLight& light) {
  check("light", light.position, light.radius);
  const glm::vec3& n = light.normal;
  if (lut::is_finite(n) && n != glm::vec3(0)) return;
  throw std::invalid_argument(fmt::format("light.normal must be finite and not zero, not ({}, {}, {})", n.x, n.y, n.z));
}

void check(const SphereLight& light) { check("light", light.position, light.radius); }

void check(const ShadowOptions& options) {
  lut::require(options.rotation >= 0 && options.rotation <= 1, "rotation", "in [0, 1] turns",
               static_cast<double>(options.rotation));
  lut::check(RayOptions{.radius = 1, .surface_offset = options.surface_offset});
}

}  // namespace

SoftShadows::SoftShadows(OccluderScene occluders, const AreaLight& light, SamplePattern pattern,
                         const ShadowOptions& options, Kernel kernel) {
  std::visit([](const auto& one) { check(one); }, light);
  check(options);
  lut::obey_isa_environment();
  tracer_ = std::make_shared<query::ShadowTracer>(std::move(occluders), light, std::move(pattern), options, kernel);
}

LightVisibility SoftShadows::query(const Receiver& receiver, std::uint64_t index) const {
  ReceiverRays rays;
  return query::ShadowTracer::Visit(*tracer_).trace(receiver, index, rays);
}

QueryReport SoftShadows::query(std::span<const Receiver> receivers, const ShadowOutputs& outputs,
                               std::uint64_t first_index, const Progress& progress) const {
  const int word_count = pattern().word_count();
  query::require_sizes(outputs, receivers.size(), word_count);
  return query::answer_in_parts(receivers.size(), progress, [&](std::size_t first, std::size_t last) {
    query::ShadowTracer::Visit visit(*tracer_, query::bounds_of(receivers.subspan(first, last - first)));
    ReceiverRays rays;
    QueryReport report;
    for (std::size_t k = first; k < last; ++k) {
      const LightVisibility answer = visit.trace(receivers[k], first_index + k, rays);
      query::store(outputs, k, word_count, answer);
      query::count(report, rays, answer);
    }
    return report;
  });
}

ReceiverRays SoftShadows::rays(const Receiver& receiver, std::uint64_t index) const {
  ReceiverRays result;
  rays(receiver, index, result);
  return result;
}

bool SoftShadows::rays(const Receiver& receiver, std::uint64_t index, ReceiverRays& rays) const {
  return tracer_->make_rays(receiver, index, rays);
}

const OccluderScene& SoftShadows::occluders() const { return tracer_->occluders(); }
const AreaLight& SoftShadows::light() const { return tracer_->light(); }
const SamplePattern& SoftShadows::pattern() const { return tracer_->pattern(); }
const ShadowOptions& SoftShadows::options() const { return tracer_->options(); }

}  // namespace lkao
