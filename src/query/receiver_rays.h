// From a receiver to the rays it casts.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 3 (orientation of
// the sample pattern, jitter).
#pragma once

#include <cstdint>

#include "lkao/ambient_occlusion.h"

namespace lkao::query {

// Three unit vectors at right angles; `axis` is where the pattern's +z goes.
struct Basis {
  glm::vec3 tangent;
  glm::vec3 bitangent;
  glm::vec3 axis;
};

// True where the position is finite and the normals are finite and not zero (a zero geometric normal stands for the
// shading normal).
bool is_valid(const Receiver& receiver);

// Unit vector of the side that the receiver lies on. Requires is_valid().
glm::vec3 geometric_normal(const Receiver& receiver);

// Where the pattern is turned for this receiver: about its normal and a little away from it, by (seed, index).
// `lowest_elevation` limits the tilt (Sec. 3: no ray below the tangent plane). Requires is_valid().
Basis jittered_basis(const Receiver& receiver, const Jitter& jitter, float lowest_elevation, std::uint64_t seed,
                     std::uint64_t index);

// The pattern at the receiver; `cast` is empty where the receiver is invalid. `largest_coordinate` is the occluders'.
void make_rays(const Receiver& receiver, const SamplePattern& pattern, const QueryOptions& options,
               float largest_coordinate, std::uint64_t index, ReceiverRays& rays);

}  // namespace lkao::query
