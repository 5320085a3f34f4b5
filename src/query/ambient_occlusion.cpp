#include "lkao/ambient_occlusion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "bvh/entry_node.h"
#include "bvh/scalar_kernel.h"
#include "bvh/simd_kernel.h"
#include "bvh/table_kernel.h"
#include "bvh/zero_area.h"
#include "lut/isa.h"
#include "query/answer.h"
#include "query/batch.h"
#include "query/receiver_rays.h"

namespace lkao {
namespace {

void require(bool condition, const char* option, const char* range, double value) {
  if (!condition) throw std::invalid_argument(fmt::format("{} must be {}, not {}", option, range, value));
}

void validate(const QueryOptions& options) {
  require(options.radius > 0 && options.radius <= bvh::kLargestCoordinate, "radius", "greater than 0 and at most 1e18",
          options.radius);
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

// Fills `rays` with the rays that the receiver casts and finds those that are blocked, from `root` on down.
OcclusionMask trace(const AmbientOcclusion& ao, const query::PatternLanes& lanes, float largest_coordinate,
                    const bvh::Node& root, const Receiver& receiver, std::uint64_t index, ReceiverRays& rays) {
  const QueryOptions& options = ao.options();
  query::make_rays(receiver, lanes, options, largest_coordinate, index, rays);
  if (!rays.cast.any()) return {};
  const bvh::Query query{root, rays, options.radius, options.sidedness, receiver.excluded_primitive};
  const bvh::Layout& layout = ao.occluders().layout();
  if (ao.table()) return bvh::trace_table(layout, query, *ao.table(), options.node_masks);
  return options.kernel == Kernel::simd ? bvh::trace_simd(layout, query, lanes.cones)
                                        : bvh::trace_scalar(layout, query);
}

}  // namespace

AmbientOcclusion::AmbientOcclusion(OccluderBvh occluders, SamplePattern pattern, const QueryOptions& options)
    : occluders_(std::move(occluders)),
      pattern_(std::move(pattern)),
      options_(options),
      lanes_(std::make_shared<query::PatternLanes>(pattern_)),
      largest_coordinate_(largest_coordinate(occluders_)) {
  validate(options_);
  lut::obey_isa_environment();
}

AmbientOcclusion::AmbientOcclusion(OccluderBvh occluders, PlaneMaskTable table, const QueryOptions& options)
    : AmbientOcclusion(std::move(occluders), table.pattern(), options) {
  table_ = std::move(table);
}

ReceiverOcclusion AmbientOcclusion::query(const Receiver& receiver, std::uint64_t index) const {
  ReceiverRays rays;
  const OcclusionMask blocked =
      trace(*this, *lanes_, largest_coordinate_, occluders_.layout().root(), receiver, index, rays);
  return query::make_answer(pattern_, receiver, rays, blocked);
}

QueryReport AmbientOcclusion::query(std::span<const Receiver> receivers, const QueryOutputs& outputs,
                                    std::uint64_t first_index) const {
  const auto answer_part = [&](std::size_t first, std::size_t last, const auto& take) {
    const std::span<const Receiver> part = receivers.subspan(first, last - first);
    const bvh::Node root = bvh::make_entry_node(
        occluders_.layout(), query::bounds_of_origins(part, options_, largest_coordinate_), options_.radius);
    ReceiverRays rays;
    for (std::size_t k = first; k < last; ++k) {
      take(k, rays, trace(*this, *lanes_, largest_coordinate_, root, receivers[k], first_index + k, rays));
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
  query::make_rays(receiver, *lanes_, options_, largest_coordinate_, index, rays);
}

}  // namespace lkao
