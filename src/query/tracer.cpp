#include "query/tracer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bvh/scalar_kernel.h"
#include "bvh/scene_query.h"
#include "bvh/simd_kernel.h"
#include "bvh/simd_scene.h"
#include "bvh/table_kernel.h"

namespace lkao::query {

Tracer::Tracer(std::span<const OccluderLevel> levels, const SamplePattern& pattern, const RayOptions& options,
               const AnyKernel& kernel)
    : options_(options),
      levels_(make_levels(levels, pattern, options)),
      extent_(extent_of(levels_)),
      lanes_(pattern, std::isinf(options.radius)),
      cones_(bvh::make_pattern_cones(pattern.directions())),
      kernel_(kernel),
      memories_(levels_.size()) {}

const PlaneMaskTable* Tracer::table() const {
  const auto* const by_table = std::get_if<ByTable>(&kernel_);
  return by_table != nullptr ? &by_table->table : nullptr;
}

void Tracer::make_rays(const Receiver& receiver, std::uint64_t index, ReceiverRays& rays) const {
  query::make_rays(receiver, lanes_, options_, extent_, index, rays);
}

bool Tracer::is_simd() const {
  const auto* const kernel = std::get_if<Kernel>(&kernel_);
  return kernel != nullptr && *kernel == Kernel::simd;
}

Tracer::Visit::Visit(const Tracer& tracer) : tracer_(tracer) {
  if (tracer.is_simd()) memories_.emplace(tracer.memories_);
}

Tracer::Visit::Visit(const Tracer& tracer, const Bounds& positions) : Visit(tracer) {
  const Bounds origins = bounds_of_origins(positions, tracer.options_, tracer.extent_.largest_coordinate);
  // More entries cost each receiver more tests, which only many rays earn back.
  const bool is_worth_more = tracer.is_simd() && tracer.lanes_.ray_count >= 256;
  const int most_children = is_worth_more ? bvh::EntryNodes::kMostChildren : bvh::kWidth;
  entries_.reserve(tracer.levels_.size());
  for (const Level& level : tracer.levels_) {
    const float far = std::min(level.r_max, tracer.options_.radius);
    entries_.emplace_back(level.occluders.layout().tree(), origins, far, most_children);
  }
}

OcclusionMask Tracer::Visit::trace(const Receiver& receiver, std::uint64_t index, ReceiverRays& rays) {
  tracer_.make_rays(receiver, index, rays);
  if (!rays.cast.any()) return {};
  const std::vector<Level>& levels = tracer_.levels_;
  const std::uint64_t key = bvh::receiver_key(tracer_.options_.seed, index);
  if (levels.size() > 1 || !levels[0].is_whole()) return trace_levels(receiver, rays, key);
  return trace_level(0, receiver, rays, key, rays.cast, nullptr);
}

bool Tracer::Visit::traces_batches() const {
  const std::vector<Level>& levels = tracer_.levels_;
  return tracer_.is_simd() && !entries_.empty() && levels.size() == 1 && levels[0].is_whole() &&
         levels[0].occluders.layout().plain() == nullptr;
}

void Tracer::Visit::trace_batch(std::span<const Receiver> receivers, std::uint64_t first_index, ReceiverRays* rays,
                                OcclusionMask* blocked) {
  std::vector<bvh::Query> queries;
  std::vector<std::size_t> askers;
  queries.reserve(receivers.size());
  askers.reserve(receivers.size());
  for (std::size_t k = 0; k < receivers.size(); ++k) {
    const Receiver& receiver = receivers[k];
    tracer_.make_rays(receiver, first_index + k, rays[k]);
    blocked[k] = {};
    if (!rays[k].cast.any()) continue;
    askers.push_back(k);
    const std::uint64_t key = bvh::receiver_key(tracer_.options_.seed, first_index + k);
    queries.push_back(make_query(0, receiver, rays[k], key, rays[k].cast, nullptr));
  }
  if (queries.empty()) return;
  std::vector<OcclusionMask> answers(queries.size());
  bvh::trace_batch(tracer_.levels_[0].occluders.layout(), queries, answers);
  for (std::size_t i = 0; i < askers.size(); ++i) blocked[askers[i]] = answers[i];
}

OcclusionMask Tracer::Visit::trace_levels(const Receiver& receiver, const ReceiverRays& rays, std::uint64_t key) {
  const std::vector<Level>& levels = tracer_.levels_;
  OcclusionMask blocked;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const Level& level = levels[i];
    const bvh::RayParts* parts = level.parts ? &*level.parts : nullptr;
    std::optional<bvh::RayParts> own_parts;
    if (parts == nullptr && !level.is_whole()) {
      // Instead of an infinite radius, each receiver has one of its own.
      own_parts = bvh::make_ray_parts(tracer_.lanes_.length, rays.radius, level.r_min, level.r_max);
      parts = &*own_parts;
    }
    OcclusionMask open = rays.cast & ~blocked;
    if (parts != nullptr) open = open & parts->existing;
    if (open.any()) blocked = blocked | trace_level(i, receiver, rays, key, open, parts);
  }
  return blocked;
}

bvh::Query Tracer::Visit::make_query(std::size_t level, const Receiver& receiver, const ReceiverRays& rays,
                                     std::uint64_t key, const OcclusionMask& open, const bvh::RayParts* parts) const {
  return {.roots = entries_.empty() ? tracer_.levels_[level].occluders.layout().roots() : entries_[level].nodes(),
          .rays = rays,
          .open = open,
          .radius = rays.radius,
          .sidedness = tracer_.options_.sidedness,
          .excluded_primitive = level == 0 ? receiver.excluded_primitive : kNoPrimitive,
          .parts = parts,
          .excluded_instance = receiver.excluded_instance,
          .groups = receiver.occluder_groups,
          .key = key};
}

OcclusionMask Tracer::Visit::trace_level(std::size_t level, const Receiver& receiver, const ReceiverRays& rays,
                                         std::uint64_t key, const OcclusionMask& open, const bvh::RayParts* parts) {
  const bvh::SceneLayout& scene = tracer_.levels_[level].occluders.layout();
  const bvh::Layout* const mesh = scene.plain();
  bvh::Query query = make_query(level, receiver, rays, key, open, parts);
  if (mesh == nullptr) return tracer_.trace(scene, query);
  if (!bvh::ask_mesh(scene, query)) return {};
  if (memories_) query.memory = &(*memories_)[level];
  return tracer_.trace(*mesh, query);
}

OcclusionMask Tracer::trace(const bvh::Layout& mesh, const bvh::Query& query) const {
  if (const auto* const by_table = std::get_if<ByTable>(&kernel_)) {
    return bvh::trace_table(mesh, query, by_table->table, by_table->node_masks);
  }
  return is_simd() ? bvh::trace_simd(mesh, query, cones_) : bvh::trace_scalar(mesh, query);
}

OcclusionMask Tracer::trace(const bvh::SceneLayout& scene, const bvh::Query& query) const {
  if (const auto* const by_table = std::get_if<ByTable>(&kernel_)) {
    return bvh::trace_table(scene, query, by_table->table, by_table->node_masks);
  }
  return is_simd() ? bvh::trace_simd(scene, query) : bvh::trace_scalar(scene, query);
}

}  // namespace lkao::query
