// All levels of one connected part, each verified against the original.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lod/distance.h"
#include "lod/part_decimater.h"
#include "scene/mesh.h"

namespace lkao::lod {

// What is asked of a level of a part.
struct PartGoal {
  double epsilon = 0;
  Sampling sampling;  // to verify it: of the original, and as many samples in all of the simplified
};

struct PartLevel {
  std::vector<SimplifiedTriangle> triangles;
  Distance from_original;
  Distance to_original;
  int redo_count = 0;      // times it was made again with the vertices locked around places beyond epsilon
  bool fell_back = false;  // to the level before, since places beyond epsilon remained
  double seconds = 0;
};

struct PartResult {
  std::vector<PartLevel> levels;  // one for each goal
  std::size_t refused_count = 0;  // PartDecimater::refused_count
};

// The goals' epsilons ascend. Each level is made of the one before, with what that has left of epsilon, and then held
// against the original.
PartResult simplify_part(const scene::Mesh& part, std::span<const PartGoal> goals,
                         const PartDecimater::OnRemoved& on_removed);

// A part as it is, within any epsilon.
PartLevel unsimplified(const scene::Mesh& part);

}  // namespace lkao::lod
