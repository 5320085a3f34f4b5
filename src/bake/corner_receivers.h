// Occlusion at vertices as the limit from inside the triangles around them.
#pragma once

#include <span>
#include <vector>

#include "bake/places.h"
#include "lkao/occluder_bvh.h"
#include "lkao/receiver.h"
#include "scene/corner_normals.h"

namespace lkao::bake {

// Three a triangle, in the order of its corners, each a little inside the triangle, so that a wall which stands on the
// vertex is beside it and not through it. `occluders`: the box around all that blocks. Triangles must be usable.
std::vector<Receiver> corner_receivers(const scene::CornerNormals& normals, const Bounds& occluders);

// The values of places: means over their corners, weighted by angle. `occlusion` is that of corner_receivers(); NaN
// counts for nothing, and a place of nothing else is NaN. Corners of slivers, in which no receiver gets away from the
// edges, count where a place has no others.
std::vector<float> average_at_places(const scene::Mesh& mesh, const Places& places, std::span<const float> occlusion,
                                     const Bounds& occluders);

}  // namespace lkao::bake
