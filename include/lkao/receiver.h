// What a query and a pass both need to know: points that receive occlusion, and the rays they cast.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 1.1 and 3.
#pragma once

#include <cstdint>

#include <glm/vec3.hpp>

#include "lkao/requirements.h"

namespace lkao {

inline constexpr std::uint32_t kNoPrimitive = 0xffffffffu;

// Of instances (OccluderInstance::groups) and what may block them: a bit for each of 32 groups.
inline constexpr std::uint32_t kAllGroups = 0xffffffffu;

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
  // Of a scene with instances: whose primitive that is.
  std::uint32_t excluded_instance = 0;
  // Only instances that share a group with it block its rays.
  std::uint32_t occluder_groups = kAllGroups;
};

enum class Sidedness {
  two_sided,  // a triangle blocks rays from both sides
  one_sided,  // a triangle blocks rays only of receivers in front of it (Laine & Karras 2010, Sec. 1.1)
};

// Per-receiver variation of the sample pattern, against banding (Laine & Karras 2010, Sec. 3).
struct Jitter {
  // Rotation about the normal, drawn evenly from [0, rotation) turns; in [0, 1].
  float rotation = 1.0f;
  // Largest tilt of the pattern's axis, in radians; in [0, pi/2]. 0 by default: beside a whole turn of rotation a tilt
  // hides no further banding, and costs accuracy (lut/README.md). Limited to what keeps the lowest ray above the
  // horizon (SamplePattern::lowest_elevation).
  float tilt = 0.0f;
};

// Of RayOptions::surface_offset. Automatic: whoever makes the receivers finds it. The query then takes its own.
inline constexpr float kAutomaticSurfaceOffset = -1.0f;
inline constexpr float kQuerySurfaceOffset = 16.0f;

// The rays of every receiver and what they meet. The same values mean the same rays to the CPU's query and to the
// OpenGL passes. What takes them throws std::invalid_argument, naming the option and its value, where one is out of
// range.
struct RayOptions {
  // AO radius: the length of the longest ray, in the unit of the positions. > 0, at most 1e18; or infinity: then every
  // ray of non-zero length goes beyond all occluders (ReceiverRays::radius), whatever share of the radius it is.
  float radius = 0;
  Sidedness sidedness = Sidedness::two_sided;
  Jitter jitter = {};
  // With a receiver's index, the only source of its jitter.
  std::uint64_t seed = 0;
  // Rays start off the surface, so that rounding does not make a receiver block itself: moved along the
  // geometric normal by surface_offset x 2^-24 x the largest coordinate in play (of the receiver or of the
  // occluders' bounds). >= 0 and finite; 0 where positions are already off the surface; or automatic: for the query
  // kQuerySurfaceOffset. An OpenGL pass adds to that what a pixel's position may be off its surface, by the formats of
  // its textures, the projection and the rasteriser (gpu/README.md), up to a quarter of a finite AO radius. Where a
  // pass shall cast the very rays of the query, give it kQuerySurfaceOffset, and positions of 32-bit floats.
  float surface_offset = kAutomaticSurfaceOffset;
  // Where rays begin to count, in the unit of the positions, measured from where they start: ray i is blocked by what
  // its part from min_distance to its end meets, bit for bit as by one OccluderLevel with that r_min. Rays no longer
  // than this are cast and are never blocked. At least 0 and less than the radius; 0: rays count from their (open)
  // start. Costs what a level of detail costs.
  float min_distance = 0;
};

}  // namespace lkao
