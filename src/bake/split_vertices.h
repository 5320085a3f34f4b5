// From values of corners to values of vertices.
#pragma once

#include <span>
#include <vector>

#include "bake/places.h"
#include "scene/mesh.h"

namespace lkao::bake {

// The value of every vertex: that of its corners; NaN where it has none. Where corners of one vertex differ, the mesh
// gets a vertex more for each further value, behind all others; the first corner's value stays with the vertex.
std::vector<float> split_vertices(scene::Mesh& mesh, const Places& places, std::span<const float> values);

}  // namespace lkao::bake
