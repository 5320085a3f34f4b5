// From the rays of a receiver to the space of a mesh that stands somewhere in the world.
#pragma once

#include "bvh/pattern_cones.h"
#include "bvh/query.h"

namespace lkao::bvh {

// Takes the open rays of `placed.world`, a query of an instance, to the space of its mesh, which lies within `mesh`.
// False where that is no matter for floats, since its transform is too flat or the numbers are too large or small.
bool place_rays(PlacedRays& placed, const Bounds& mesh);

// How far off corners are, by axis, for rays in the space of a mesh: their own displacement, that of the origin, and
// what the definition grants. The origin and the longest ray in the world and in the mesh's space, or what is larger.
glm::vec3 uncertainty(const Placement& placement, const glm::vec3& origin, float radius, const glm::vec3& placed_origin,
                      float placed_radius);

// What they ask of the mesh's hierarchy. Must not outlive them.
Query query_of(const PlacedRays& placed);

// The rays of such an answer by their numbers in the world.
OcclusionMask in_world(const PlacedRays& placed, const OcclusionMask& blocked);

// Cones that say nothing: rays that were picked from a pattern, and turned and stretched, keep none of its order.
const PatternCones& cones_of_any_rays();

}  // namespace lkao::bvh
