// From a receiver to its rays, and to those of them that the occluders of all levels block.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "bvh/entry_nodes.h"
#include "bvh/pattern_cones.h"
#include "bvh/query.h"
#include "bvh/scene_layout.h"
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

   private:
    // `key`: bvh::receiver_key.
    OcclusionMask trace_levels(const Receiver& receiver, const ReceiverRays& rays, std::uint64_t key);
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

}  // namespace lkao::query
