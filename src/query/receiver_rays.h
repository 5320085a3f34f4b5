// From a receiver to the rays it casts.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 3 (orientation of
// the sample pattern, jitter).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lkao/ambient_occlusion.h"
#include "query/levels.h"

namespace lkao::query {

// Where occluders are.
struct OccluderExtent {
  Bounds bounds;                 // of all levels; lower > upper where there is none
  float largest_coordinate = 0;  // magnitude, of the first level: what the surface offset is relative to
};
OccluderExtent extent_of(std::span<const Level> levels);

// True where the position is finite and the normals are finite and not zero (a zero geometric normal stands for the
// shading normal).
bool is_valid(const Receiver& receiver);

// Unit vector of the side that the receiver lies on. Requires is_valid().
glm::vec3 geometric_normal(const Receiver& receiver);

// Where the pattern's axes go at this receiver, a rotation: about its normal and a little away from it, by (seed,
// index). `lowest_elevation` limits the tilt (Sec. 3: no ray below the tangent plane). Requires is_valid().
glm::mat3 jittered_frame(const Receiver& receiver, const Jitter& jitter, float lowest_elevation, std::uint64_t seed,
                         std::uint64_t index);

// A rotation whose last column is the unit vector `axis`, turned about it by so many turns.
glm::mat3 frame_around(const glm::dvec3& axis, double turn);

// How far the rays of a receiver there start above the surface.
float offset_of(const glm::vec3& position, const RayOptions& options, float largest_coordinate);

// A sample pattern component by component, so that vectors can be made of it: up to whole words of a mask, with rays
// that have neither direction nor length, which are never cast.
struct PatternLanes {
  // `is_unbounded`: every ray that has a length has length 1, whatever share of an infinite radius it is.
  explicit PatternLanes(const SamplePattern& pattern, bool is_unbounded = false);

  std::vector<float> x, y, z, length;
  int ray_count;
  float lowest_elevation;
};

// A box around all positions that are in range; lower > upper where there is none.
Bounds bounds_of(std::span<const Receiver> receivers);

// A box around the origins of the rays of receivers anywhere in the box `positions`. Empty where that is.
Bounds bounds_of_origins(const Bounds& positions, const RayOptions& options, float largest_coordinate);

// A radius that no point of `occluders` is farther away than from `origin`: a power of two, so that rays of this length
// are exact multiples of their directions. 1 where there is no occluder.
float radius_beyond(const Bounds& occluders, const glm::vec3& origin);

// The pattern at the receiver; `cast` is empty where the receiver is invalid.
void make_rays(const Receiver& receiver, const PatternLanes& pattern, const RayOptions& options,
               const OccluderExtent& occluders, std::uint64_t index, ReceiverRays& rays);

}  // namespace lkao::query
