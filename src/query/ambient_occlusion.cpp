#include "lkao/ambient_occlusion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "bvh/zero_area.h"
#include "lut/isa.h"
#include "query/answer.h"
#include "query/batch.h"
#include "query/receiver_rays.h"
#include "query/tracer.h"

namespace lkao {
namespace {

void require(bool condition, const char* option, const char* range, double value) {
  if (!condition) throw std::invalid_argument(fmt::format("{} must be {}, not {}", option, range, value));
}

void validate(const QueryOptions& options) {
  require(options.radius > 0 && (options.radius <= bvh::kLargestCoordinate || std::isinf(options.radius)), "radius",
          "greater than 0 and at most 1e18, or infinity", options.radius);
  require(options.jitter.rotation >= 0 && options.jitter.rotation <= 1, "jitter.rotation", "in [0, 1] turns",
          options.jitter.rotation);
  require(options.jitter.tilt >= 0 && options.jitter.tilt <= 0.5f * std::numbers::pi_v<float>, "jitter.tilt",
          "in [0, pi/2] radians", options.jitter.tilt);
  require(std::isfinite(options.surface_offset) && options.surface_offset >= 0, "surface_offset",
          "finite and at least 0", options.surface_offset);
}

void validate(const std::vector<OccluderLevel>& levels) {
  if (levels.empty()) throw std::invalid_argument("levels must be at least one, not 0");
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const float r_min = levels[i].r_min, r_max = levels[i].r_max;
    if (r_min >= 0 && r_min < r_max) continue;
    throw std::invalid_argument(fmt::format("levels[{}] must have 0 <= r_min < r_max, not {} and {}", i, r_min, r_max));
  }
}

void validate(const PlaneMaskTable& table, const QueryOptions& options) {
  const auto lengths = table.pattern().lengths();
  if (std::isinf(options.radius) && std::any_of(lengths.begin(), lengths.end(), [](float l) { return l != 1; })) {
    throw std::invalid_argument("radius must be finite, not inf, for a plane mask table of rays of several lengths");
  }
}

}  // namespace

AmbientOcclusion::AmbientOcclusion(OccluderBvh occluders, SamplePattern pattern, const QueryOptions& options)
    : AmbientOcclusion(std::vector{OccluderLevel{std::move(occluders)}}, std::move(pattern), options, {}) {}

AmbientOcclusion::AmbientOcclusion(const std::vector<OccluderLevel>& levels, SamplePattern pattern,
                                   const QueryOptions& options)
    : AmbientOcclusion(levels, std::move(pattern), options, {}) {}

AmbientOcclusion::AmbientOcclusion(OccluderBvh occluders, PlaneMaskTable table, const QueryOptions& options)
    : AmbientOcclusion(std::vector{OccluderLevel{std::move(occluders)}}, table.pattern(), options, table) {}

AmbientOcclusion::AmbientOcclusion(const std::vector<OccluderLevel>& levels, SamplePattern pattern,
                                   const QueryOptions& options, std::optional<PlaneMaskTable> table)
    : pattern_(std::move(pattern)) {
  validate(options);
  validate(levels);
  if (table) validate(*table, options);
  tracer_ = std::make_shared<query::Tracer>(levels, pattern_, options, std::move(table));
  lut::obey_isa_environment();
}

ReceiverOcclusion AmbientOcclusion::query(const Receiver& receiver, std::uint64_t index) const {
  ReceiverRays rays;
  this->rays(receiver, index, rays);
  const OcclusionMask blocked = query::Tracer::Visit(*tracer_).trace(rays, receiver.excluded_primitive);
  return query::make_answer(pattern_, receiver, rays, blocked);
}

QueryReport AmbientOcclusion::query(std::span<const Receiver> receivers, const QueryOutputs& outputs,
                                    std::uint64_t first_index) const {
  const auto answer_part = [&](std::size_t first, std::size_t last, const auto& take) {
    const Bounds origins = query::bounds_of_origins(receivers.subspan(first, last - first), options(),
                                                    tracer_->extent().largest_coordinate);
    query::Tracer::Visit visit(*tracer_, origins);
    ReceiverRays rays;
    for (std::size_t k = first; k < last; ++k) {
      this->rays(receivers[k], first_index + k, rays);
      take(k, rays, visit.trace(rays, receivers[k].excluded_primitive));
    }
  };
  return query::run_batch(pattern_, receivers, outputs, answer_part);
}

ReceiverRays AmbientOcclusion::rays(const Receiver& receiver, std::uint64_t index) const {
  ReceiverRays result;
  rays(receiver, index, result);
  return result;
}

void AmbientOcclusion::rays(const Receiver& receiver, std::uint64_t index, ReceiverRays& rays) const {
  query::make_rays(receiver, tracer_->lanes(), options(), tracer_->extent(), index, rays);
}

const OccluderBvh& AmbientOcclusion::occluders() const { return tracer_->first_occluders(); }
const QueryOptions& AmbientOcclusion::options() const { return tracer_->options(); }
const PlaneMaskTable* AmbientOcclusion::table() const { return tracer_->table(); }

}  // namespace lkao
