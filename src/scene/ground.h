// A ground under a scene, for models that come without one.
#pragma once

#include "scene/mesh.h"

namespace lkao::scene {

// How far the ground reaches beyond the scene where the AO radius is longer, in diagonals of the scene's box. Rays of a
// wall as high as that diagonal then miss no more than the last 0.6 degrees above the horizon, 0.6 % of a wall's rays.
inline constexpr double kGroundReach = 100;

// A square of two triangles, facing up: a ten-thousandth of the diagonal below the lowest point of `mesh` along `up`,
// so that it fights with no bottom for one plane and stays below floors of the scene's own. It reaches beyond the scene
// by `radius`, which may be infinite, but by 1 diagonal at least and kGroundReach at most. It has the mesh's origin.
// Throws std::invalid_argument where `up` is zero or not finite, or the mesh has no finite triangle.
Mesh make_ground(const Mesh& mesh, const glm::vec3& up, double radius);

}  // namespace lkao::scene
