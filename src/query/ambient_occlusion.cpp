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
#include "query/levels.h"
#include "query/receiver_rays.h"

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

OcclusionMask trace(const AmbientOcclusion& ao, const query::PatternLanes& lanes, const bvh::Layout& layout,
                    const bvh::Query& query) {
  const QueryOptions& options = ao.options();
  if (ao.table()) return bvh::trace_table(layout, query, *ao.table(), options.node_masks);
  return options.kernel == Kernel::simd ? bvh::trace_simd(layout, query, lanes.cones)
                                        : bvh::trace_scalar(layout, query);
}

// Finds the rays that some level blocks. `root_of(level)` is where to enter its hierarchy.
template <typename RootOf>
OcclusionMask trace_levels(const AmbientOcclusion& ao, const query::PatternLanes& lanes,
                           const std::vector<query::Level>& levels, const RootOf& root_of,
                           std::uint32_t excluded_primitive, const ReceiverRays& rays) {
  const auto trace_level = [&](std::size_t i, const OcclusionMask& open, const bvh::RayParts* parts) {
    const bvh::Query query{.root = root_of(i),
                           .rays = rays,
                           .open = open,
                           .radius = rays.radius,
                           .sidedness = ao.options().sidedness,
                           .excluded_primitive = i == 0 ? excluded_primitive : kNoPrimitive,
                           .parts = parts};
    return trace(ao, lanes, levels[i].occluders.layout(), query);
  };
  if (!rays.cast.any()) return {};
  if (levels.size() == 1 && levels[0].is_whole()) return trace_level(0, rays.cast, nullptr);
  OcclusionMask blocked;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    OcclusionMask open = rays.cast & ~blocked;
    if (levels[i].is_whole()) {
      if (open.any()) blocked = blocked | trace_level(i, open, nullptr);
      continue;
    }
    // Instead of an infinite radius, each receiver has one of its own.
    std::optional<bvh::RayParts> own_parts;
    if (!levels[i].parts) {
      own_parts = bvh::make_ray_parts(lanes.length, rays.radius, levels[i].r_min, levels[i].r_max);
    }
    const bvh::RayParts& parts = own_parts ? *own_parts : *levels[i].parts;
    open = open & parts.existing;
    if (open.any()) blocked = blocked | trace_level(i, open, &parts);
  }
  return blocked;
}

}  // namespace

AmbientOcclusion::AmbientOcclusion(OccluderBvh occluders, SamplePattern pattern, const QueryOptions& options)
    : AmbientOcclusion(std::vector{OccluderLevel{std::move(occluders)}}, std::move(pattern), options) {}

AmbientOcclusion::AmbientOcclusion(std::vector<OccluderLevel> levels, SamplePattern pattern,
                                   const QueryOptions& options)
    : pattern_(std::move(pattern)),
      options_(options),
      lanes_(std::make_shared<query::PatternLanes>(pattern_, std::isinf(options.radius))) {
  validate(options_);
  validate(levels);
  levels_ = std::make_shared<std::vector<query::Level>>(query::make_levels(levels, pattern_, options_.radius));
  extent_ = std::make_shared<query::OccluderExtent>(query::extent_of(*levels_));
  lut::obey_isa_environment();
}

AmbientOcclusion::AmbientOcclusion(OccluderBvh occluders, PlaneMaskTable table, const QueryOptions& options)
    : AmbientOcclusion(std::move(occluders), table.pattern(), options) {
  const auto lengths = table.pattern().lengths();
  if (std::isinf(options.radius) && std::any_of(lengths.begin(), lengths.end(), [](float l) { return l != 1; })) {
    throw std::invalid_argument("radius must be finite, not inf, for a plane mask table of rays of several lengths");
  }
  table_ = std::move(table);
}

ReceiverOcclusion AmbientOcclusion::query(const Receiver& receiver, std::uint64_t index) const {
  ReceiverRays rays;
  this->rays(receiver, index, rays);
  const auto root_of = [&](std::size_t level) -> const bvh::Node& {
    return (*levels_)[level].occluders.layout().root();
  };
  const OcclusionMask blocked = trace_levels(*this, *lanes_, *levels_, root_of, receiver.excluded_primitive, rays);
  return query::make_answer(pattern_, receiver, rays, blocked);
}

QueryReport AmbientOcclusion::query(std::span<const Receiver> receivers, const QueryOutputs& outputs,
                                    std::uint64_t first_index) const {
  const auto answer_part = [&](std::size_t first, std::size_t last, const auto& take) {
    const std::span<const Receiver> part = receivers.subspan(first, last - first);
    const Bounds origins = query::bounds_of_origins(part, options_, extent_->largest_coordinate);
    std::vector<bvh::Node> roots;
    for (const query::Level& level : *levels_) {
      const float far = std::min(level.r_max, options_.radius);
      roots.push_back(bvh::make_entry_node(level.occluders.layout(), origins, far));
    }
    const auto root_of = [&](std::size_t level) -> const bvh::Node& { return roots[level]; };
    ReceiverRays rays;
    for (std::size_t k = first; k < last; ++k) {
      this->rays(receivers[k], first_index + k, rays);
      const std::uint32_t excluded = receivers[k].excluded_primitive;
      take(k, rays, trace_levels(*this, *lanes_, *levels_, root_of, excluded, rays));
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
  query::make_rays(receiver, *lanes_, options_, *extent_, index, rays);
}

const OccluderBvh& AmbientOcclusion::occluders() const { return levels_->front().occluders; }

}  // namespace lkao
