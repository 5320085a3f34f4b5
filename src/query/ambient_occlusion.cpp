#include "lkao/ambient_occlusion.h"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "lut/isa.h"
#include "lut/ray_options.h"
#include "query/answer.h"
#include "query/batch.h"
#include "query/receiver_rays.h"
#include "query/tracer.h"

namespace lkao {
namespace {

void check(const std::vector<OccluderLevel>& levels) {
  if (levels.empty()) throw std::invalid_argument("levels must be at least one, not 0");
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const float r_min = levels[i].r_min, r_max = levels[i].r_max;
    if (r_min >= 0 && r_min < r_max) continue;
    throw std::invalid_argument(fmt::format("levels[{}] must have 0 <= r_min < r_max, not {} and {}", i, r_min, r_max));
  }
  for (std::size_t i = 1; i < levels.size(); ++i) {
    if (levels[i].occluders.origin() == levels[0].occluders.origin()) continue;
    throw std::invalid_argument(fmt::format("levels[{}] must have the origin of levels[0]", i));
  }
}

}  // namespace

AmbientOcclusion::AmbientOcclusion(OccluderScene occluders, SamplePattern pattern, const RayOptions& options,
                                   Kernel kernel)
    : AmbientOcclusion(std::vector{OccluderLevel{std::move(occluders)}}, std::move(pattern), options, kernel) {}

AmbientOcclusion::AmbientOcclusion(const std::vector<OccluderLevel>& levels, SamplePattern pattern,
                                   const RayOptions& options, Kernel kernel)
    : pattern_(std::move(pattern)) {
  lut::check(options);
  check(levels);
  lut::obey_isa_environment();
  tracer_ = std::make_shared<query::Tracer>(levels, pattern_, options, kernel);
}

AmbientOcclusion::AmbientOcclusion(OccluderScene occluders, PlaneMaskTable table, const RayOptions& options,
                                   NodeMasks node_masks)
    : pattern_(table.pattern()) {
  lut::check(options);
  lut::check(options, table);
  const std::vector levels{OccluderLevel{std::move(occluders)}};
  tracer_ = std::make_shared<query::Tracer>(levels, pattern_, options, query::ByTable{std::move(table), node_masks});
}

ReceiverOcclusion AmbientOcclusion::query(const Receiver& receiver, std::uint64_t index) const {
  ReceiverRays rays;
  const OcclusionMask blocked = query::Tracer::Visit(*tracer_).trace(receiver, index, rays);
  return query::make_answer(pattern_, receiver, rays, blocked);
}

OcclusionMask AmbientOcclusion::blocked(const Receiver& receiver, std::uint64_t index) const {
  ReceiverRays rays;
  return query::Tracer::Visit(*tracer_).trace(receiver, index, rays);
}

QueryReport AmbientOcclusion::query(std::span<const Receiver> receivers, const QueryOutputs& outputs,
                                    std::uint64_t first_index, const Progress& progress) const {
  query::require_sizes(outputs, receivers.size(), pattern_.word_count());
  return query::answer_in_parts(receivers.size(), progress, [&](std::size_t first, std::size_t last) {
    query::Tracer::Visit visit(*tracer_, query::bounds_of(receivers.subspan(first, last - first)));
    QueryReport report;
    const auto answer = [&](std::size_t k, const ReceiverRays& rays, const OcclusionMask& blocked) {
      query::store(outputs, first + k, pattern_, receivers[first + k], rays, blocked);
      query::count(report, rays, blocked);
    };
    visit.trace_each(receivers.subspan(first, last - first), first_index + first, answer);
    return report;
  });
}

ReceiverRays AmbientOcclusion::rays(const Receiver& receiver, std::uint64_t index) const {
  ReceiverRays result;
  rays(receiver, index, result);
  return result;
}

void AmbientOcclusion::rays(const Receiver& receiver, std::uint64_t index, ReceiverRays& rays) const {
  tracer_->make_rays(receiver, index, rays);
}

const OccluderScene& AmbientOcclusion::occluders() const { return tracer_->first_occluders(); }
const RayOptions& AmbientOcclusion::options() const { return tracer_->options(); }
const PlaneMaskTable* AmbientOcclusion::table() const { return tracer_->table(); }

}  // namespace lkao
