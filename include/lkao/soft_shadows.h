// Soft shadows: what share of a light a receiver sees.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 7 (future work:
// shadows of area lights by the same masks).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "lkao/ambient_occlusion.h"
#include "lkao/area_light.h"
#include "lkao/export.h"
#include "lkao/kernel.h"
#include "lkao/occluder_scene.h"
#include "lkao/occlusion_mask.h"
#include "lkao/progress.h"
#include "lkao/receiver.h"
#include "lkao/receiver_rays.h"
#include "lkao/requirements.h"
#include "lkao/sample_pattern.h"

namespace lkao {

namespace query {
class ShadowTracer;
}

// What SoftShadows throws std::invalid_argument for, naming the option and its value, where it is out of range.
struct ShadowOptions {
  Sidedness sidedness = Sidedness::two_sided;
  // The light's points are turned about its axis from receiver to receiver, against banding: by up to so many turns, in
  // [0, 1].
  float rotation = 1.0f;
  // With a receiver's index, the only source of its turn.
  std::uint64_t seed = 0;
  // As RayOptions::surface_offset. Rays end before the light by the same rule, with its coordinates in play too, so
  // that what the light touches, a ceiling with a disc in it, does not hide it.
  float surface_offset = kAutomaticSurfaceOffset;
};

// The answer for one receiver.
struct LightVisibility {
  // Share of the light that the receiver sees, 0 to 1: neither occluders nor its own surface hide it. NaN where the
  // receiver is invalid, as in ReceiverOcclusion, or 5e17 or more from the light.
  float visibility = 0;
  // Share of the light above the horizon of the receiver's geometric normal. A renderer that has already cut the light
  // at the horizon wants visibility / above_horizon of what is left of it.
  float above_horizon = 0;
  // Bit i: the ray to point i of the light is blocked. Zero where it is not cast, since the point is below the horizon
  // or where the ray begins.
  OcclusionMask blocked;
};

// Where a batch puts its answers: each span is empty (not wanted) or has an entry for every receiver.
struct ShadowOutputs {
  std::span<float> visibility = {};
  std::span<float> above_horizon = {};
  // SamplePattern::word_count() words for every receiver, receiver after receiver.
  std::span<std::uint64_t> mask_words = {};
};

// Visibility of one light in one scene. Immutable and cheap to copy; every member may be called from any number
// of threads.
//
// From each receiver rays go to points that are spread evenly over the light, by area or solid angle as area_light.h
// says: those of a pattern's disk, so that neighbouring bits are neighbouring points. They begin off the surface, end
// at the light, and are blocked as those of RayBundles. The light is no occluder: leave its own mesh, if it has one,
// out of the scene or behind what it shines from. Rays to points below the horizon of the geometric normal are not
// cast; of the shading normal no ray depends.
//
// Stack and memory of blockers as AmbientOcclusion, and 50 KiB of stack more. Receivers in order, neighbours after
// neighbours, are fastest.
class LKAO_API SoftShadows {
 public:
  // The points are pattern.disk(); lengths are of no account. They are even for patterns weighted by the cosine, the
  // default. Throws std::invalid_argument, naming the argument and its value, where a coordinate of the light is no
  // number or beyond 1e17, its radius not above 0 or beyond 1e17, its normal zero or not finite, or an option out of
  // range.
  SoftShadows(OccluderScene occluders, const AreaLight& light, SamplePattern pattern = SamplePattern::standard(128),
              const ShadowOptions& options = {}, Kernel kernel = Kernel::simd);

  // One receiver, in the calling thread; `index` with the seed gives the turn.
  LightVisibility query(const Receiver& receiver, std::uint64_t index) const;

  // Many, in parallel, in the TBB arena of the caller. Receiver k has index first_index + k. Throws
  // std::invalid_argument where a span of the outputs has the wrong size, and Cancelled where `progress`, which counts
  // receivers, stops it. Of the report, rays are those above the horizon.
  QueryReport query(std::span<const Receiver> receivers, const ShadowOutputs& outputs, std::uint64_t first_index = 0,
                    const Progress& progress = {}) const;

  // The rays that `query` casts, bit for bit: what a reference ray tracer must be given. Of ReceiverRays, `frame` is
  // that of the light, and `radius` no less than the longest ray. The second returns false where the receiver is
  // invalid: then no ray is cast, as for one whose horizon hides the light.
  ReceiverRays rays(const Receiver& receiver, std::uint64_t index) const;
  bool rays(const Receiver& receiver, std::uint64_t index, ReceiverRays& rays) const;

  const OccluderScene& occluders() const;
  const AreaLight& light() const;
  const SamplePattern& pattern() const;
  const ShadowOptions& options() const;

 private:
  std::shared_ptr<const query::ShadowTracer> tracer_;
};

}  // namespace lkao
