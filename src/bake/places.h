// Corners of triangles that get one value together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "scene/corner_normals.h"
#include "scene/shared_edges.h"

namespace lkao::bake {

// Cosine of the bend over an edge up to which triangles without normals of their own count as one smooth surface: more
// than the sides of an octagon bend, less than those of a hexagon or a box.
inline constexpr double kSmoothBend = 0.6;

// What has a value each.
enum class Per {
  vertex,  // of the file; those on both sides of a seam have the same one
  corner,  // of a triangle; but corners at one position that shade as one surface have the same one
  face,
};

struct Places {
  std::vector<glm::uvec3> of_corner;  // of each triangle
  std::size_t count = 0;
};

// For vertices or corners. Corners at one position shade as one surface where they are joined by edges and have the
// same normal; or where all have their facet's normal, by edges that bend little.
Places make_places(const scene::CornerNormals& normals, Per per);

// Whether corners at both ends of an edge shade as one surface with those on the other side, by the same rule.
bool shades_as_one(const scene::CornerNormals& normals, const scene::SharedEdge& edge);

}  // namespace lkao::bake
