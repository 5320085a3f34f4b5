#include "lkao/ambient_occlusion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "bvh/scalar_kernel.h"
#include "query/answer.h"
#include "query/batch.h"
#include "query/receiver_rays.h"

namespace lkao {
namespace {

void require(bool condition, const char* option, const char* range, double value) {
  if (!condition) throw std::invalid_argument(fmt::format("{} must be {}, not {}", option, range, value));
}

void validate(const QueryOptions& options) {
  require(std::isfinite(options.radius) && options.radius > 0, "radius", "finite and greater than 0", options.radius);
  require(options.jitter.rotation >= 0 && options.jitter.rotation <= 1, "jitter.rotation", "in [0, 1] turns",
          options.jitter.rotation);
  require(options.jitter.tilt >= 0 && options.jitter.tilt <= 0.5f * std::numbers::pi_v<float>, "jitter.tilt",
          "in [0, pi/2] radians", options.jitter.tilt);
  require(std::isfinite(options.surface_offset) && options.surface_offset >= 0, "surface_offset",
          "finite and at least 0", options.surface_offset);
}

// Magnitude of the largest coordinate of any occluder; 0 where there is none.
float largest_coordinate(const OccluderBvh& occluders) {
  if (occluders.report().occluder_count == 0) return 0;
  const Bounds& bounds = occluders.bounds();
  float largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    largest = std::max({largest, std::fabs(bounds.lower[axis]), std::fabs(bounds.upper[axis])});
  }
  return largest;
}

ReceiverOcclusion answer(const AmbientOcclusion& ao, const Receiver& receiver, std::uint64_t index,
                         ReceiverRays& rays) {
  const QueryOptions& options = ao.options();
  query::make_rays(receiver, ao.pattern(), options, largest_coordinate(ao.occluders()), index, rays);
  OcclusionMask blocked;
  if (rays.cast.any()) {
    blocked = bvh::trace_scalar(ao.occluders().layout(), {rays, query::geometric_normal(receiver), options.radius,
                                                          options.sidedness, receiver.excluded_primitive});
  }
  return query::make_answer(receiver, rays, blocked);
}

}  // namespace

AmbientOcclusion::AmbientOcclusion(OccluderBvh occluders, SamplePattern pattern, const QueryOptions& options)
    : occluders_(std::move(occluders)), pattern_(std::move(pattern)), options_(options) {
  validate(options_);
}

ReceiverOcclusion AmbientOcclusion::query(const Receiver& receiver, std::uint64_t index) const {
  ReceiverRays rays;
  return answer(*this, receiver, index, rays);
}

QueryReport AmbientOcclusion::query(std::span<const Receiver> receivers, const QueryOutputs& outputs,
                                    std::uint64_t first_index) const {
  return query::run_batch(receivers, outputs, pattern_.word_count(), first_index,
                          [this](const Receiver& receiver, std::uint64_t index, ReceiverRays& rays) {
                            return answer(*this, receiver, index, rays);
                          });
}

ReceiverRays AmbientOcclusion::rays(const Receiver& receiver, std::uint64_t index) const {
  ReceiverRays rays;
  query::make_rays(receiver, pattern_, options_, largest_coordinate(occluders_), index, rays);
  return rays;
}

}  // namespace lkao
