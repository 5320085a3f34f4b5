#include "bvh/spatial_bins.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>
#include <glm/common.hpp>

#include "bvh/triangle_clip.h"
#include "support/meshes.h"

namespace lkao::bvh {
namespace {

std::vector<Piece> pieces_of(const PackedMesh& mesh, PieceSet& set) {
  std::vector<Piece> pieces;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::vec3 &a = mesh.corner(i, 0), &b = mesh.corner(i, 1), &c = mesh.corner(i, 2);
    const glm::vec3 lower = glm::min(a, glm::min(b, c)), upper = glm::max(a, glm::max(b, c));
    pieces.emplace_back(Box{{lower.x, lower.y, lower.z, 0}, {upper.x, upper.y, upper.z, 0}}, i);
    set.include(pieces.back());
  }
  set.end = set.room_end = pieces.size();
  return pieces;
}

SpatialSplit best_split(const PackedMesh& mesh, const PieceSet& set, const std::vector<Piece>& pieces) {
  const SlabMap map(set);
  SpatialBins bins;
  bins.add(pieces, map, mesh);
  return bins.best(map);
}

// A sliver along the diagonal of a square: in the middle it is cut into two that fill a quarter of the square each.
TEST(SpatialBins, CutADiagonalInTheMiddle) {
  const PackedMesh mesh{{{0, 0, 0}, {8, 8, 0}, {8, 8, 0.01f}}, {{0, 1, 2}}};
  PieceSet set;
  const std::vector<Piece> pieces = pieces_of(mesh, set);
  const SpatialSplit split = best_split(mesh, set, pieces);
  EXPECT_EQ(split.plane, 4);
  EXPECT_EQ(split.left_count, 1u);
  EXPECT_EQ(split.right_count, 1u);
  EXPECT_NEAR(split.cost, 32, 0.5);
}

// What the bins say of the best plane is what cutting each triangle there gives.
TEST(SpatialBins, AgreeWithCuttingEachTriangle) {
  for (const int count : {2, 5, 20, 300}) {
    const PackedMesh mesh = pack(tests::random_soup(count, 0.7f, 61).view());
    PieceSet set;
    const std::vector<Piece> pieces = pieces_of(mesh, set);
    const SpatialSplit split = best_split(mesh, set, pieces);
    Box left = empty_box(), right = empty_box();
    std::size_t left_count = 0, right_count = 0;
    for (const Piece& piece : pieces) {
      const auto [a, b] = cut_triangle(mesh, piece.primitive(), piece.box, split.axis, split.plane);
      if (!is_empty(a)) left = merge(left, a), ++left_count;
      if (!is_empty(b)) right = merge(right, b), ++right_count;
    }
    EXPECT_EQ(split.left_count, left_count) << count;
    EXPECT_EQ(split.right_count, right_count) << count;
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(split.left.lower[axis], left.lower[axis], 1e-4) << count;
      EXPECT_NEAR(split.left.upper[axis], left.upper[axis], 1e-4) << count;
      EXPECT_NEAR(split.right.lower[axis], right.lower[axis], 1e-4) << count;
      EXPECT_NEAR(split.right.upper[axis], right.upper[axis], 1e-4) << count;
    }
  }
}

}  // namespace
}  // namespace lkao::bvh
