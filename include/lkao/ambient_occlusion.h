// The query: which shadow rays of a receiver are blocked.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Eq. 3 and
// Sec. 5 (traversal once for all rays of a receiver).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "lkao/export.h"
#include "lkao/kernel.h"
#include "lkao/occluder_bvh.h"
#include "lkao/occluder_scene.h"
#include "lkao/occlusion_mask.h"
#include "lkao/plane_mask_table.h"
#include "lkao/progress.h"
#include "lkao/receiver.h"
#include "lkao/receiver_rays.h"
#include "lkao/requirements.h"
#include "lkao/sample_pattern.h"

namespace lkao {

class Neighbourhood;
namespace query {
class Tracer;
}

// Occluders that block rays only at some distances: a level of detail. A ray is blocked if its part whose distance from
// the origin lies in [r_min, r_max] meets one of them (Laine & Karras 2010, Sec. 4.3).
struct OccluderLevel {
  OccluderScene occluders;
  float r_min = 0;
  float r_max = std::numeric_limits<float>::infinity();
};

// The answer for one receiver.
struct ReceiverOcclusion {
  // Share of the cast rays that are blocked, 0 to 1. NaN where the receiver is invalid: a non-finite
  // position, a zero or non-finite normal, or normals so opposed that no ray can be cast.
  float occlusion = 0;
  // Mean direction of the cast rays that are not blocked, a unit vector in world space; the receiver's
  // normal where all are blocked; NaN where the receiver is invalid.
  glm::vec3 bent_normal{0};
  // Bit i: ray i is blocked. Zero where the ray is not cast or the receiver is invalid.
  OcclusionMask mask;
};

// Where a batch puts its answers: each span is empty (not wanted) or has an entry for every receiver.
struct QueryOutputs {
  std::span<float> occlusion = {};
  std::span<glm::vec3> bent_normals = {};
  // SamplePattern::word_count() words for every receiver, receiver after receiver.
  std::span<std::uint64_t> mask_words = {};
};

struct QueryReport {
  std::size_t receiver_count = 0;
  std::size_t invalid_receiver_count = 0;  // answered with NaN
  std::uint64_t ray_count = 0;             // cast
  std::uint64_t blocked_ray_count = 0;

  // As of a query that was answered in parts.
  QueryReport& operator+=(const QueryReport& part) {
    receiver_count += part.receiver_count;
    invalid_receiver_count += part.invalid_receiver_count;
    ray_count += part.ray_count;
    blocked_ray_count += part.blocked_ray_count;
    return *this;
  }
};

// Answers queries against one scene with one pattern. Immutable and cheap to copy; every member may be
// called from any number of threads.
//
// Ray i of a receiver at p is blocked by triangle T if the segment (p, p + length_i direction_i], open at p,
// meets the closed triangle T, and, one-sided, T's front faces p. This is decided in double precision from
// the float coordinates; a ray that passes an edge within the rounding of that (some 1e-15) counts as
// blocked, so closed meshes do not leak. The same arguments give the same bits at any number of threads.
//
// Costs: making one prepares up to 20 KiB from the pattern, and 8 KiB for each level that has a range or a
// min_distance; it copies no hierarchy. A copy is three shared pointers. The time of a query grows with the occluders
// within the radius, and with the number of rays more slowly than in proportion: one query of 128 rays is far cheaper
// than eight of 16. What it allocates and its stack are said at query().
//
// Where most rays are blocked, as in rooms at a long radius, each thread remembers which triangles blocked rays and
// tests them first. That memory takes some 40 KiB for each thread and level of detail, for 64 threads at most; copies
// share it, and it goes with the last of them. Answers do not depend on it: what it names is tested like any other
// triangle.
class LKAO_API AmbientOcclusion {
 public:
  // Throws std::invalid_argument, naming the option and its value, where one is out of range.
  AmbientOcclusion(OccluderScene occluders, SamplePattern pattern, const RayOptions& options,
                   Kernel kernel = Kernel::simd);

  // Several levels of detail, near ones first is fastest: usually the scene itself from 0 to some distance, and simpler
  // versions of it farther away. The first is what occluders() returns, what surface_offset is relative to and what
  // Receiver::excluded_primitive counts. With the same occluders in all levels, and ranges that leave no gap, the
  // answers are those without levels, bit for bit. Throws std::invalid_argument where there is no level, or a range is
  // not 0 <= r_min < r_max.
  AmbientOcclusion(const std::vector<OccluderLevel>& levels, SamplePattern pattern, const RayOptions& options,
                   Kernel kernel = Kernel::simd);

  // Answers with the paper's look-ups instead of ray by ray: the pattern is the table's. With PlaneMasks::must_may the
  // answers are the same bit for bit, with PlaneMasks::nearest they are approximate (lut/README.md has the figures).
  // Throws std::invalid_argument also for an infinite radius where the table's rays are not all of one length.
  AmbientOcclusion(OccluderScene occluders, PlaneMaskTable table, const RayOptions& options,
                   NodeMasks node_masks = NodeMasks::box_outline);

  // One receiver, in the calling thread. `index` with the seed gives the jitter: use the pixel, the vertex
  // or the sample number. Allocates nothing but the thread's memory of blockers, once. Needs 120 KiB of stack, and
  // 2.5 KiB more for each level of nodes in the hierarchy (some 10; never more than 64); with instances 60 KiB more,
  // and the levels of nodes over them count as well. So does every other query, in each thread that runs it.
  ReceiverOcclusion query(const Receiver& receiver, std::uint64_t index) const;

  // The mask alone, for those who count its bits themselves: no bent normal is computed, which is a loop over all rays.
  // Empty for an invalid receiver, as for one that nothing blocks. Occlusion is its count over that of
  // ReceiverRays::cast, which is all rays unless there is a geometric normal of its own or a tilt. Threads, memory and
  // stack as of query().
  OcclusionMask blocked(const Receiver& receiver, std::uint64_t index) const;

  // For receivers one by one whose positions lie in this box: a tile of an image, a patch of a surface. They are
  // answered as query() answers them, faster (neighbourhood.h). Throws std::invalid_argument where the box is empty or
  // not finite.
  Neighbourhood around(const Bounds& positions) const;

  // Many receivers, in parallel, in the TBB arena of the caller. Receiver k has index first_index + k. In scenes of
  // instances neighbours are answered together, 64 at a time, fewer of more than 128 rays: neighbours should follow one
  // another. Each thread takes 1.5 MiB for that meanwhile.
  // Throws std::invalid_argument where a span of the outputs has the wrong size, and Cancelled where `progress`, which
  // counts receivers, stops it: some entries of the outputs are answers then, the others are what they were.
  QueryReport query(std::span<const Receiver> receivers, const QueryOutputs& outputs, std::uint64_t first_index = 0,
                    const Progress& progress = {}) const;

  // The rays that `query` casts for this receiver, bit for bit: what a reference ray tracer must be given.
  ReceiverRays rays(const Receiver& receiver, std::uint64_t index) const;
  void rays(const Receiver& receiver, std::uint64_t index, ReceiverRays& rays) const;

  const OccluderScene& occluders() const;
  const SamplePattern& pattern() const { return pattern_; }
  const RayOptions& options() const;
  // The table of a query by look-ups; null otherwise.
  const PlaneMaskTable* table() const;

 private:
  SamplePattern pattern_;
  std::shared_ptr<const query::Tracer> tracer_;
};

}  // namespace lkao
