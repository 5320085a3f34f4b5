// From rays of a common origin, whatever they are, to those of them that occluders block.
#pragma once

#include <cstdint>
#include <optional>

#include "bvh/bundle_shape.h"
#include "bvh/entry_nodes.h"
#include "lkao/kernel.h"
#include "lkao/occluder_scene.h"
#include "lkao/receiver.h"
#include "lkao/receiver_rays.h"
#include "query/blocker_memories.h"

namespace lkao::query {

// Any number of threads may use it, each through a Visit of its own.
class BundleTracer {
 public:
  BundleTracer(OccluderScene occluders, Sidedness sidedness, Kernel kernel);

  const OccluderScene& occluders() const { return occluders_; }
  Sidedness sidedness() const { return sidedness_; }

  // What one thread needs to trace bundles one after the other.
  class Visit {
   public:
    // Enters at the root.
    explicit Visit(const BundleTracer& tracer);
    // For bundles whose origins and ends lie within these boxes: enters as deep as that allows.
    Visit(const BundleTracer& tracer, const Bounds& origins, const Bounds& ends);

    // Those of rays.cast that are blocked, of a receiver that excludes what `receiver` does. Of `rays`, origin,
    // ray_count, cast and the components must be set, components of at most 1e18, up to a whole word of the mask; the
    // other members are of use to kernels and are set here.
    // `key`: bvh::receiver_key, which triangles with holes are thinned by.
    OcclusionMask trace(const Receiver& receiver, std::uint64_t key, ReceiverRays& rays);

   private:
    // Those of `shape_`, which is of these rays.
    OcclusionMask trace_shape(const Receiver& receiver, std::uint64_t key, const ReceiverRays& rays);

    const BundleTracer& tracer_;
    bvh::BundleShape shape_;
    std::optional<bvh::EntryNodes> entries_;
    std::optional<BlockerMemories::Loan> memories_;
  };

 private:
  OccluderScene occluders_;
  Sidedness sidedness_;
  Kernel kernel_;
  mutable BlockerMemories memories_;
};

}  // namespace lkao::query
