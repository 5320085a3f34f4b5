// Bundles: which of any rays of a common origin are blocked, found as the query finds it, at once.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 5 (traversal once
// for all rays) and Sec. 7 (other uses of it).
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <glm/vec3.hpp>

#include "lkao/export.h"
#include "lkao/kernel.h"
#include "lkao/occluder_scene.h"
#include "lkao/occlusion_mask.h"
#include "lkao/progress.h"
#include "lkao/receiver.h"
#include "lkao/requirements.h"

namespace lkao {

namespace query {
class BundleTracer;
}

// Rays that begin at one point: segments from `origin` to `origin + rays[i]`, in world space and the unit of the
// positions. From kMinRayCount to kMaxRayCount of them. Owns nothing.
struct RayBundle {
  glm::vec3 origin{0};
  std::span<const glm::vec3> rays;
  // What cannot block them, as in Receiver.
  std::uint32_t excluded_primitive = kNoPrimitive;
  std::uint32_t excluded_instance = 0;
  std::uint32_t occluder_groups = kAllGroups;
  // What triangles with holes are thinned by, beside the ray's number (CutOuts).
  std::uint64_t index = 0;
};

// Answers bundles against one scene. Immutable and cheap to copy; every member may be called from any number of
// threads.
//
// Ray i is blocked by triangle T if the segment (origin, origin + rays[i]], open at the origin, meets the closed T,
// and, one-sided, T's front faces the origin: the words of ambient_occlusion.h. It is decided in double precision, with
// the same bits on every kernel, instruction set and number of threads. What rounding leaves open counts as blocked:
// some 1e-15 of the longest ray for AmbientOcclusion; here of the longest ray or a thousand times that of the ray
// itself, whichever is less, however different the lengths of a bundle are. A ray of length 0 meets nothing. Rays start
// where they are said to: who shades a surface moves the origin off it (RayOptions::surface_offset says how far).
//
// Speed comes from what rays have in common. Any order gives the same bits; neighbouring rays (of 16, of 64) that point
// the same way are several times as fast as shuffled ones (bvh/README.md, "Bundles"). Memory, stack and blockers that
// are remembered: as said at AmbientOcclusion, and 50 KiB of stack more.
class LKAO_API RayBundles {
 public:
  explicit RayBundles(OccluderScene occluders, Sidedness sidedness = Sidedness::two_sided,
                      Kernel kernel = Kernel::simd);

  // One bundle, in the calling thread. Bit i: rays[i] is blocked. Throws std::invalid_argument where the number of rays
  // is out of range, a coordinate of the origin is no number or beyond 1e18, or one of a ray no number or beyond 5e17,
  // which it names.
  OcclusionMask blocked(const glm::vec3& origin, std::span<const glm::vec3> rays,
                        std::uint32_t excluded_primitive = kNoPrimitive) const;

  // Many, in parallel, in the TBB arena of the caller: masks[k] is that of bundles[k]. Neighbouring bundles should have
  // neighbouring origins. Throws as above, and where there are not as many masks as bundles; and Cancelled where
  // `progress`, which counts bundles, stops it: some masks are answers then, the others what they were.
  void blocked(std::span<const RayBundle> bundles, std::span<OcclusionMask> masks, const Progress& progress = {}) const;

  const OccluderScene& occluders() const;
  Sidedness sidedness() const;

 private:
  std::shared_ptr<const query::BundleTracer> tracer_;
};

}  // namespace lkao
