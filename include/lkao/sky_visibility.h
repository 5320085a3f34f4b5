// What share of all directions a receiver sees the sky in: above its surface and below, for leaves and other thin
// things that light comes to from both sides.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "lkao/ambient_occlusion.h"
#include "lkao/export.h"
#include "lkao/kernel.h"
#include "lkao/occluder_scene.h"
#include "lkao/progress.h"
#include "lkao/receiver.h"
#include "lkao/requirements.h"

namespace lkao {

struct SkyOptions {
  // Where the sky begins: RayOptions::radius.
  float radius = std::numeric_limits<float>::infinity();
  Sidedness sidedness = Sidedness::two_sided;
  // With a receiver's index, the only source of its jitter.
  std::uint64_t seed = 0;
  // RayOptions::surface_offset: rays of each side start off the surface on that side, so that a leaf hides nothing from
  // itself.
  float surface_offset = kAutomaticSurfaceOffset;
};

// Shares of solid angle, 0 to 1; NaN where the receiver is invalid (ReceiverOcclusion).
struct SkyShares {
  float visibility = 0;  // of the whole sphere: the mean of both sides
  float above = 0;       // of the hemisphere on the side of the geometric normal
  float below = 0;       // of the other one
};

// Answers the whole sphere of a receiver as two hemispheres of AmbientOcclusion, evenly weighted: exact and as fast as
// that. Immutable and cheap to copy; every member may be called from any number of threads. Memory and stack are those
// of two AmbientOcclusion.
class LKAO_API SkyVisibility {
 public:
  // `ray_count`: of the whole sphere, rounded up to an even number; from 2 to twice kMaxRayCount. Throws
  // std::invalid_argument, naming the argument and its value, where that or an option is out of range.
  explicit SkyVisibility(OccluderScene occluders, int ray_count = 256, const SkyOptions& options = {},
                         Kernel kernel = Kernel::simd);

  // One receiver, in the calling thread; `index` with the seed gives the jitter.
  SkyShares query(const Receiver& receiver, std::uint64_t index) const;

  // Many, in parallel, in the TBB arena of the caller: shares[k] is that of receivers[k], of index first_index + k.
  // Takes some 50 bytes a receiver while it runs. Throws std::invalid_argument where there are not as many shares as
  // receivers, and Cancelled where `progress`, which counts every receiver twice, stops it. Of the report, rays are
  // those of both sides.
  QueryReport query(std::span<const Receiver> receivers, std::span<SkyShares> shares, std::uint64_t first_index = 0,
                    const Progress& progress = {}) const;

 private:
  AmbientOcclusion above_, below_;
};

}  // namespace lkao
