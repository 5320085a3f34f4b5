// From a receiver to its rays, and to those of them that the occluders of all levels block.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "bvh/entry_nodes.h"
#include "bvh/pattern_cones.h"
#include "bvh/query.h"
#include "bvh/scene_layout.h"
#include "bvh/simd_batch.h"
#include "lkao/ambient_occlusion.h"
#include "query/blocker_memories.h"
#include "query/levels.h"
#include "query/receiver_rays.h"

namespace lkao::query {

// Answers by look-ups.
struct ByTable {
  PlaneMaskTable table;
  NodeMasks node_masks;
};
using AnyKernel = std::variant<Kernel, ByTable>;

// All that an AmbientOcclusion has prepared. Any number of threads may use it, each through a Visit of its own.
class Tracer {
 public:
  // The arguments must have been checked.
  Tracer(std::span<const OccluderLevel> levels, const SamplePattern& pattern, const RayOptions& options,
         const AnyKernel& kernel);

  const RayOptions& options() const { return options_; }
  const OccluderScene& first_occluders() const { return levels_.front().occluders; }
  const PlaneMaskTable* table() const;

  // The rays that a receiver of this index casts.
  void make_rays(const Receiver& receiver, std::uint64_t index, ReceiverRays& rays) const;

  // What one thread needs to trace receivers one after the other: the nodes where it enters each hierarchy, and its
  // memory of what blocked rays before.
  class Visit {
   public:
    // For receivers anywhere: enters at the roots.
    explicit Visit(const Tracer& tracer);
    // For receivers that lie within the box `positions`.
    Visit(const Tracer& tracer, const Bounds& positions);

    // Makes the rays that the receiver casts; returns those that are blocked.
    OcclusionMask trace(const Receiver& receiver, std::uint64_t index, ReceiverRays& rays);

    // The same for receivers of the indices from `first_index` on: calls `answer(k, rays, blocked)` for each in order.
    template <typename Answer>
    void trace_each(std::span<const Receiver> receivers, std::uint64_t first_index, const Answer& answer);

   private:
    // `key`: bvh::receiver_key.
    OcclusionMask trace_levels(const Receiver& receiver, const ReceiverRays& rays, std::uint64_t key);
    // Whether receivers are better traced several at a time: in scenes of instances.
    bool traces_batches() const;
    // So many receivers, `rays` and `blocked`.
    void trace_batch(std::span<const Receiver> receivers, std::uint64_t first_index, ReceiverRays* rays,
                     OcclusionMask* blocked);
    bvh::Query make_query(std::size_t level, const Receiver& receiver, const ReceiverRays& rays, std::uint64_t key,
                          const OcclusionMask& open, const bvh::RayParts* parts) const;
    OcclusionMask trace_level(std::size_t level, const Receiver& receiver, const ReceiverRays& rays, std::uint64_t key,
                              const OcclusionMask& open, const bvh::RayParts* parts);

    const Tracer& tracer_;
    std::vector<bvh::EntryNodes> entries_;  // one for each level; empty: enter at the roots
    std::optional<BlockerMemories::Loan> memories_;
  };

 private:
  bool is_simd() const;
  OcclusionMask trace(const bvh::Layout& mesh, const bvh::Query& query) const;
  OcclusionMask trace(const bvh::SceneLayout& scene, const bvh::Query& query) const;

  RayOptions options_;
  std::vector<Level> levels_;
  OccluderExtent extent_;
  PatternLanes lanes_;
  bvh::PatternCones cones_;
  AnyKernel kernel_;
  mutable BlockerMemories memories_;
};

template <typename Answer>
void Tracer::Visit::trace_each(std::span<const Receiver> receivers, std::uint64_t first_index, const Answer& answer) {
  const bool in_batches = traces_batches();
  const auto most = static_cast<std::size_t>(in_batches ? bvh::max_batch_receivers(tracer_.lanes_.ray_count) : 1);
  const std::size_t room = std::clamp<std::size_t>(receivers.size(), 1, most);
  // Not filled with zeros. libc++ 14 has no std::make_unique_for_overwrite.
  const std::unique_ptr<ReceiverRays[]> rays(new ReceiverRays[room]);
  std::vector<OcclusionMask> blocked(room);
  for (std::size_t first = 0; first < receivers.size(); first += most) {
    const std::size_t count = std::min(most, receivers.size() - first);
    if (in_batches) {
      trace_batch(receivers.subspan(first, count), first_index + first, rays.get(), blocked.data());
    } else {
      blocked[0] = trace(receivers[first], first_index + first, rays[0]);
    }
    for (std::size_t k = 0; k < count; ++k) answer(first + k, rays[k], blocked[k]);
  }
}

}  // namespace lkao::query
