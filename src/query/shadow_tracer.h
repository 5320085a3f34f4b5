// From a receiver to the rays to a light, and to those of them that occluders block.
#pragma once

#include <cstdint>

#include "lkao/soft_shadows.h"
#include "query/bundle_tracer.h"
#include "query/light_rays.h"
#include "query/receiver_rays.h"

namespace lkao::query {

// All that a SoftShadows has prepared. Any number of threads may use it, each through a Visit of its own.
class ShadowTracer {
 public:
  // The arguments must have been checked.
  ShadowTracer(OccluderScene occluders, const AreaLight& light, SamplePattern pattern, const ShadowOptions& options,
               Kernel kernel);

  const OccluderScene& occluders() const { return bundles_.occluders(); }
  const AreaLight& light() const { return light_; }
  const SamplePattern& pattern() const { return pattern_; }
  const ShadowOptions& options() const { return options_; }

  // False, and no ray, where the receiver is invalid.
  bool make_rays(const Receiver& receiver, std::uint64_t index, ReceiverRays& rays) const;

  // What one thread needs to trace receivers one after the other.
  class Visit {
   public:
    // For receivers anywhere.
    explicit Visit(const ShadowTracer& tracer) : tracer_(tracer), bundles_(tracer.bundles_) {}
    // For receivers that lie within the box `positions`.
    Visit(const ShadowTracer& tracer, const Bounds& positions);

    // Makes the rays that the receiver casts.
    LightVisibility trace(const Receiver& receiver, std::uint64_t index, ReceiverRays& rays);

   private:
    const ShadowTracer& tracer_;
    BundleTracer::Visit bundles_;
  };

 private:
  Bounds ends() const;

  BundleTracer bundles_;
  AreaLight light_;
  SamplePattern pattern_;
  ShadowOptions options_;
  RayOptions ray_options_;  // what they mean for receivers
  PatternLanes disk_;
  // Of the occluders, and of light and occluders: magnitudes that rounding is relative to.
  float largest_coordinate_, largest_at_light_;
};

}  // namespace lkao::query
