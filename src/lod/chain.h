// A chain of levels of detail: the same occluders ever more coarsely, each level for a range of distances along the
// ray.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 4.3.
#pragma once

#include <vector>

#include "scene/mesh.h"

namespace lkao::lod {

// One level: the occluders of the part of a ray between the distances r_min and r_max from its origin.
struct Level {
  scene::Mesh mesh;
  float epsilon = 0;  // allowed distance to the original mesh, and of the original mesh to this one; 0: the original
  float r_min = 0;
  float r_max = 0;  // of the last level infinity
};

// Level 0 is the original mesh, unchanged, at [0, k epsilon_1]; level i >= 1 is within epsilon_i of it, at
// [k epsilon_i, k epsilon_(i + 1)]. The ranges tile [0, infinity): a level's r_max is the next one's r_min, bit for
// bit.
struct Chain {
  float k = 0;
  float growth = 0;
  std::vector<Level> levels;
};

// What fixes the levels' errors and ranges.
struct LevelRule {
  float epsilon = 0;    // of level 1, in the unit of the positions; > 0 where there is more than one level
  float k = 3;          // how many times its error a level stays away from the receiver; > 0, usually 2 to 5
  float growth = 3;     // epsilon_(i + 1) / epsilon_i; > 1
  int level_count = 4;  // with the original; 1 to kMaxLevelCount
};
inline constexpr int kMaxLevelCount = 16;

// A chain with all its epsilons and ranges, and no meshes yet.
// Throws std::invalid_argument naming the argument and its value where one is out of range.
Chain empty_chain(const LevelRule& rule);

// The epsilon of level 1 for an AO radius: the last level begins at half of the radius, so that it answers for 7/8 of
// the half ball that the rays reach, and every level lies within the radius. With one level, the radius / (2 k).
// Throws std::invalid_argument as empty_chain does, and where the radius is not positive and finite.
float automatic_epsilon(float radius, const LevelRule& rule);

// The same for a radius that may be infinite: then it is the diagonal of the mesh's bounds, beyond which rays from
// within meet nothing.
float automatic_epsilon(const scene::Mesh& mesh, float radius, const LevelRule& rule);

}  // namespace lkao::lod
