// Built-in scenes: deterministic, made by code, y up. The same bits on every machine.
//
// The small ones have a known answer, for constant falloff. Occlusion of a receiver on their floor y = 0, with its
// normal up and an AO radius that reaches what is named (measured from the receiver, without jitter's tilt):
//
//   plane   An open plane.                       0 everywhere.
//   box     A closed box of side 2, its floor    1 everywhere inside, for a radius beyond 2 sqrt(3).
//           at y = 0, around (0, 1, 0).
//   wall    The plane z = 0, 200 wide and 100    (acos t - t sqrt(1 - t^2)) / pi with t = z / radius, for a distance
//           high, on a floor.                    0 < z <= radius < 100 and |x| + radius <= 100: 1/2 at the foot, 0 from
//                                                z = radius on.
//   disk    A disk of radius 1 at height 1       R^2 / (R^2 + h^2) = 1/2 at the origin, for a radius beyond sqrt(2).
//           above the origin.
//   sphere  A sphere of radius 1 around          (R / d)^2 = 1/4 at the origin, for a radius beyond sqrt(3) (where the
//           (0, 2, 0).                           tangents touch).
//
// Disk and sphere are polygons of the same area as the circle that they stand for; the answers hold to 1e-4.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scene/camera.h"
#include "scene/mesh.h"
#include "scene/radius.h"

namespace lkao::scene {

struct BuiltinScene {
  std::string name;         // without "builtin:"
  std::string description;  // one line
  Camera camera;            // a view that shows it
  SuggestedRadii radii;     // AO radii that suit it
};

// All of them, in the order they are listed to the user: atrium, city, hairball, and the small ones with known
// answers: plane, box, wall, disk, sphere.
const std::vector<BuiltinScene>& builtin_scenes();

// Throws std::runtime_error naming the unknown name and the known ones.
const BuiltinScene& builtin_scene(const std::string& name);

// Throws as builtin_scene.
Mesh make_builtin(const std::string& name);

// A vaulted hall, 30 x 14 units inside and 11 high, about 350 K triangles: from walls of two triangles to fluted
// shafts.
Mesh make_atrium();

// Blocks of buildings over 1500 x 1500 units, about 880 K triangles (after the City of Laine & Karras 2010, Table 1,
// and its radii 75 and 225).
Mesh make_city();

// Thin tubes wound around a core, in a ball of radius 5 (after the Hairball of Laine & Karras 2010, Table 1, and its
// radii 0.1 and 0.3). As many hairs of 480 triangles as come nearest to the count, and the core's 2,880.
Mesh make_hairball(std::size_t triangle_count);

Mesh make_plane();
Mesh make_box();
Mesh make_wall();
Mesh make_disk();
Mesh make_sphere();

}  // namespace lkao::scene
