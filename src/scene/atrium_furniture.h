// What stands in builtin:atrium.
#pragma once

#include <vector>

#include "scene/shapes.h"

namespace lkao::scene {

// How far things stand in what they stand on, so that no two faces lie in one plane.
inline constexpr double kAtriumSink = 0.02;

// Adds a half torus between two heights to a lathe profile, bulging outwards from the given radius.
void add_bulge(std::vector<glm::dvec2>& profile, double inner_radius, double low, double high, int step_count);

// An open vessel, about as high as `scale`.
void add_urn(Mesh& mesh, const glm::dvec3& base, double scale);

// A square block with foot and cover, twice `half` wide.
void add_pedestal(Mesh& mesh, const glm::dvec3& base, double half, double height);

// All that stands on the floor: the basin in the middle, benches, urns, balls.
void add_atrium_furniture(Mesh& mesh);

}  // namespace lkao::scene
