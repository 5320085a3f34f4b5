// Makes a chain of levels of a mesh.
#pragma once

#include <cstddef>
#include <vector>

#include "lkao/progress.h"
#include "lod/chain.h"
#include "lod/distance.h"

namespace lkao::lod {

struct SimplifyOptions {
  LevelRule levels;
  // Connected parts of fewer triangles than this are taken as they are.
  std::size_t min_part_triangle_count = 4;
};

// How one level came out. Distances and counts are 0 for level 0, the original.
struct LevelReport {
  std::size_t triangle_count = 0;
  double area = 0;                         // of the surface: what it loses is lost as occluder
  double spacing = 0;                      // of the samples that measured; on large triangles wider
  Distance from_original;                  // from samples of the original to the level
  Distance to_original;                    // from samples of the level to the original
  std::size_t redone_part_count = 0;       // made again, since they had places beyond epsilon
  std::size_t fallen_back_part_count = 0;  // as in the level before, since such places remained
  double thread_seconds = 0;               // summed over the parts
};

// Where the triangles of the input went:
// triangle_count = zero_area + non_finite + duplicate + small_part_triangle + simplified_part_triangle.
struct SimplifyReport {
  std::size_t triangle_count = 0;
  // Left out of the simplified levels: they block nothing that the others do not.
  std::size_t zero_area_count = 0;
  std::size_t non_finite_count = 0;
  std::size_t duplicate_count = 0;
  // In parts too small to simplify; they are in every level as they are.
  std::size_t small_part_count = 0;
  std::size_t small_part_triangle_count = 0;
  // In parts that went through the decimater.
  std::size_t simplified_part_count = 0;
  std::size_t simplified_part_triangle_count = 0;
  // Of the latter: refused by OpenMesh as neighbours of the others; with vertices of their own, they are in every
  // level.
  std::size_t refused_count = 0;
  // What was not manifold.
  std::size_t wrong_winding_edge_count = 0;  // between two triangles that wind in opposite senses
  std::size_t crowded_edge_count = 0;        // of more than two triangles
  std::size_t split_vertex_count = 0;        // became several, so that every part is a manifold
  std::vector<LevelReport> levels;           // one for each level of the chain
};

struct Simplified {
  Chain chain;
  SimplifyReport report;
};

// Parallel over the connected parts, in the TBB arena of the caller; the same chain at any number of threads. Every
// measured maximum distance of a level is at most its epsilon: a part that cannot keep to it stays finer.
// Throws std::invalid_argument naming the argument and its value where an option is out of range, an index is, or where
// the mesh has no triangle; Cancelled where `progress` stops it.
Simplified simplify(const scene::Mesh& mesh, const SimplifyOptions& options, const Progress& progress = {});

}  // namespace lkao::lod
