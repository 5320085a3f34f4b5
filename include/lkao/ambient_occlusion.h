// The query: which shadow rays of a receiver are blocked.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Eq. 3 and
// Sec. 5 (traversal once for all rays of a receiver).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "lkao/occluder_bvh.h"
#include "lkao/occlusion_mask.h"
#include "lkao/plane_mask_table.h"
#include "lkao/sample_pattern.h"

namespace lkao {

namespace query {
class Tracer;
}

inline constexpr std::uint32_t kNoPrimitive = 0xffffffffu;

// A point that receives occlusion. Positions and normals in world space; normals of any length.
struct Receiver {
  glm::vec3 position{0};
  // The axis of the sample pattern: the shading normal.
  glm::vec3 normal{0};
  // The side of the surface the receiver lies on: rays below this normal's horizon are not cast, and the
  // origin is moved off the surface along it. Zero means: the same as `normal`.
  glm::vec3 geometric_normal{0};
  // A primitive that cannot block this receiver's rays (usually the one it lies on).
  std::uint32_t excluded_primitive = kNoPrimitive;
};

enum class Sidedness {
  two_sided,  // a triangle blocks rays from both sides
  one_sided,  // a triangle blocks rays only of receivers in front of it (Laine & Karras 2010, Sec. 1.1)
};

// Per-receiver variation of the sample pattern, against banding (Laine & Karras 2010, Sec. 3).
struct Jitter {
  // Rotation about the normal, drawn evenly from [0, rotation) turns; in [0, 1].
  float rotation = 1.0f;
  // Largest tilt of the pattern's axis, in radians; in [0, pi/2]. None by default: with a whole turn of rotation it
  // hides no more structure and costs accuracy (lut/README.md). Never more than would bring the lowest ray to the
  // horizon (SamplePattern::lowest_elevation), whatever is asked.
  float tilt = 0.0f;
};

// What answers a query; the bits are the same.
enum class Kernel {
  simd,    // vectors of the fastest instruction set that the processor has
  scalar,  // the readable definition of the result
};

// How the table kernel finds the rays that may meet a node (Laine & Karras 2010, Sec. 5).
enum class NodeMasks {
  bounding_sphere,  // one or two look-ups (Figure 4)
  box_outline,      // tighter, faster on CPUs: a look-up for each edge of the box's outline and each face seen
};

struct QueryOptions {
  // AO radius: the length of the longest ray, in the unit of the positions. > 0, at most 1e18; or infinity: then every
  // ray of non-zero length goes beyond all occluders (ReceiverRays::radius), whatever share of the radius it is.
  float radius = 0;
  Sidedness sidedness = Sidedness::two_sided;
  Jitter jitter = {};
  // With a receiver's index, the only source of its jitter.
  std::uint64_t seed = 0;
  // Rays start off the surface, so that rounding does not make a receiver block itself: moved along the
  // geometric normal by surface_offset x 2^-24 x the largest coordinate in play (of the receiver or of the
  // occluders' bounds). >= 0 and finite; 0 where positions are already off the surface.
  float surface_offset = 16.0f;
  // Only for queries without a plane mask table.
  Kernel kernel = Kernel::simd;
  // Only for queries with a plane mask table.
  NodeMasks node_masks = NodeMasks::box_outline;
};

// Occluders that block rays only at some distances: a level of detail. A ray is blocked if its part whose distance from
// the origin lies in [r_min, r_max] meets one of them (Laine & Karras 2010, Sec. 4.3).
struct OccluderLevel {
  OccluderBvh occluders;
  float r_min = 0;
  float r_max = std::numeric_limits<float>::infinity();
};

// The rays that a receiver casts, in world space: segments from `origin` to `origin + ray(i)`.
struct ReceiverRays {
  glm::vec3 origin{0};
  // A rotation: where the pattern's axes go; the last column is near the normal. The direction of ray i is
  // frame x pattern().directions()[i].
  glm::mat3 frame{1};
  // Unit vector, the geometric normal: no cast ray goes below its horizon.
  glm::vec3 up{0, 0, 1};
  // The AO radius. Where that is infinite, a power of two that no occluder is farther away than from this origin: with
  // rays of that length instead, nothing changes.
  float radius = 0;
  // Rays above the geometric horizon; the others are not cast. Empty for an invalid receiver.
  OcclusionMask cast;
  int ray_count = 0;
  // Direction x length of each ray, component by component.
  alignas(64) float x[kMaxRayCount];
  alignas(64) float y[kMaxRayCount];
  alignas(64) float z[kMaxRayCount];

  glm::vec3 ray(int i) const { return {x[i], y[i], z[i]}; }
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
};

// Answers queries against one hierarchy with one pattern. Immutable and cheap to copy; every member may be
// called from any number of threads.
//
// Ray i of a receiver at p is blocked by triangle T if the segment (p, p + length_i direction_i], open at p,
// meets the closed triangle T, and, one-sided, T's front faces p. This is decided in double precision from
// the float coordinates; a ray that passes an edge within the rounding of that (some 1e-15) counts as
// blocked, so closed meshes do not leak. The same arguments give the same bits at any number of threads.
//
// Where most rays are blocked, as in rooms at a long radius, each thread remembers what blocked them and tries it
// first: some 40 KiB a thread and level, 64 of them at most, shared by copies and gone with the last. Answers do not
// depend on it: what it names is tested like any other triangle.
class AmbientOcclusion {
 public:
  // Throws std::invalid_argument, naming the option and its value, where one is out of range.
  AmbientOcclusion(OccluderBvh occluders, SamplePattern pattern, const QueryOptions& options);

  // Several levels of detail, near ones first is fastest: usually the scene itself from 0 to some distance, and simpler
  // versions of it farther away. The first is what occluders() returns, what surface_offset is relative to and what
  // Receiver::excluded_primitive counts. With the same occluders in all levels, and ranges that leave no gap, the
  // answers are those without levels, bit for bit. Throws std::invalid_argument where there is no level, or a range is
  // not 0 <= r_min < r_max.
  AmbientOcclusion(const std::vector<OccluderLevel>& levels, SamplePattern pattern, const QueryOptions& options);

  // Answers with the paper's look-ups instead of ray by ray: the pattern is the table's. With PlaneMasks::must_may the
  // answers are the same bit for bit, with PlaneMasks::nearest they are approximate (lut/README.md has the figures).
  // Throws std::invalid_argument also for an infinite radius where the table's rays are not all of one length.
  AmbientOcclusion(OccluderBvh occluders, PlaneMaskTable table, const QueryOptions& options);

  // One receiver, in the calling thread. `index` with the seed gives the jitter: use the pixel, the vertex
  // or the sample number. Allocates nothing but the thread's memory of blockers, once.
  ReceiverOcclusion query(const Receiver& receiver, std::uint64_t index) const;

  // Many receivers, in parallel, in the TBB arena of the caller. Receiver k has index first_index + k.
  // Throws std::invalid_argument where a span of the outputs has the wrong size.
  QueryReport query(std::span<const Receiver> receivers, const QueryOutputs& outputs,
                    std::uint64_t first_index = 0) const;

  // The rays that `query` casts for this receiver, bit for bit: what a reference ray tracer must be given.
  ReceiverRays rays(const Receiver& receiver, std::uint64_t index) const;
  void rays(const Receiver& receiver, std::uint64_t index, ReceiverRays& rays) const;

  const OccluderBvh& occluders() const;
  const SamplePattern& pattern() const { return pattern_; }
  const QueryOptions& options() const;
  // The table of a query by look-ups; null otherwise.
  const PlaneMaskTable* table() const;

 private:
  AmbientOcclusion(const std::vector<OccluderLevel>& levels, SamplePattern pattern, const QueryOptions& options,
                   std::optional<PlaneMaskTable> table);

  SamplePattern pattern_;
  std::shared_ptr<const query::Tracer> tracer_;
};

}  // namespace lkao
