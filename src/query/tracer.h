// From the rays of a receiver to those that the occluders of all levels block.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "bvh/entry_nodes.h"
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
  // Nothing is checked here.
  Tracer(std::span<const OccluderLevel> levels, const SamplePattern& pattern, const RayOptions& options,
         const AnyKernel& kernel);

  const RayOptions& options() const { return options_; }
  const OccluderBvh& first_occluders() const { return levels_.front().occluders; }
  const OccluderExtent& extent() const { return extent_; }
  const PatternLanes& lanes() const { return lanes_; }
  const PlaneMaskTable* table() const;

  // What one thread needs to trace receivers one after the other: where to enter each hierarchy, and what blocked rays
  // before.
  class Visit {
   public:
    // To any receivers: enters at the roots.
    explicit Visit(const Tracer& tracer);
    // To receivers whose rays begin within `origins`.
    Visit(const Tracer& tracer, const Bounds& origins);

    // Of the rays that are cast, those that are blocked.
    OcclusionMask trace(const ReceiverRays& rays, std::uint32_t excluded_primitive);

   private:
    OcclusionMask trace_level(std::size_t level, const ReceiverRays& rays, const OcclusionMask& open,
                              const bvh::RayParts* parts, std::uint32_t excluded_primitive);

    const Tracer& tracer_;
    std::vector<bvh::EntryNodes> entries_;  // by level; none: the roots
    std::optional<BlockerMemories::Loan> memories_;
  };

 private:
  bool is_simd() const;

  RayOptions options_;
  std::vector<Level> levels_;
  OccluderExtent extent_;
  PatternLanes lanes_;
  AnyKernel kernel_;
  mutable BlockerMemories memories_;
};

}  // namespace lkao::query
