#include "lut/plane_cells.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "lut/planes.h"

namespace lkao::lut {
namespace {

using tests::Plane;

const std::vector<glm::vec3>& special_normals() {
  static const std::vector<glm::vec3> normals = [] {
    std::vector<glm::vec3> all;
    for (int x = -2; x <= 2; ++x) {
      for (int y = -2; y <= 2; ++y) {
        for (int z = -2; z <= 2; ++z) {
          if (x != 0 || y != 0 || z != 0) all.push_back(glm::normalize(glm::vec3(x, y, z)));
        }
      }
    }
    return all;
  }();
  return normals;
}

class PlaneCellsOf : public testing::TestWithParam<std::tuple<PlaneAddressing, int>> {
 protected:
  PlaneAddressing addressing() const { return std::get<0>(GetParam()); }
  int resolution() const { return std::get<1>(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(All, PlaneCellsOf,
                         testing::Combine(testing::Values(PlaneAddressing::cube, PlaneAddressing::slices),
                                          testing::Values(32, 33, 64, 128)));

// The address is computed in float: its rounding is far below kPlaneMargin.
constexpr double kAddressRounding = 1.5e-6;

testing::AssertionResult holds(const PlaneCell& cell, const Plane& plane) {
  if (!cell.is_used) return testing::AssertionFailure() << "the cell is unused";
  const double angle = tests::angle_between(cell.axis, plane.normal),
               most = std::asin(static_cast<double>(cell.angle_sin));
  if (angle > most + kAddressRounding) {
    return testing::AssertionFailure() << "angle " << angle << " of the normal exceeds " << most;
  }
  const auto distance = static_cast<double>(plane.distance);
  if (distance < static_cast<double>(cell.nearest_distance) - kAddressRounding ||
      distance > static_cast<double>(cell.farthest_distance) + kAddressRounding) {
    return testing::AssertionFailure() << "distance outside " << cell.nearest_distance << " to "
                                       << cell.farthest_distance;
  }
  return testing::AssertionSuccess();
}

TEST_P(PlaneCellsOf, HoldSpecialPlanes) {
  const PlaneCells cells(addressing(), resolution());
  for (const glm::vec3& normal : special_normals()) {
    ASSERT_TRUE(holds(cells.geometry(cells.edge_cell(normal)), {normal, 0}));
    // Distances 0 and 1, and the borders of the cells along this normal, at them and just before.
    const std::uint32_t count = 1024;
    for (std::uint32_t i = 0; i <= count; ++i) {
      const float distance = static_cast<float>(i) / static_cast<float>(count);
      const PlaneCell cell = cells.geometry(cells.cell(normal, distance));
      for (const float d :
           {distance, cell.nearest_distance, cell.farthest_distance, std::nextafter(cell.nearest_distance, 0.0f),
            std::nextafter(cell.farthest_distance, 1.0f)}) {
        const Plane plane{normal, d};
        ASSERT_TRUE(holds(cells.geometry(cells.cell(plane.normal, plane.distance)), plane))
            << "normal " << normal.x << ' ' << normal.y << ' ' << normal.z << ", distance " << d;
      }
    }
  }
}

TEST_P(PlaneCellsOf, HoldMillionsOfPlanes) {
  const PlaneCells cells(addressing(), resolution());
  lut::RandomStream random(121);
  for (int i = 0; i < 400'000; ++i) {
    const Plane plane{tests::random_direction(random), tests::uniform(random, 0, 1)};
    const std::uint32_t cell = cells.cell(plane.normal, plane.distance), edge = cells.edge_cell(plane.normal);
    ASSERT_LT(std::max(cell, edge), cells.cell_count());
    ASSERT_TRUE(holds(cells.geometry(cell), plane)) << i;
    ASSERT_TRUE(holds(cells.geometry(edge), {plane.normal, 0})) << i;
  }
}

// Distances that rounding brought out of range are those at the ends of the range.
TEST_P(PlaneCellsOf, ClampDistances) {
  const PlaneCells cells(addressing(), resolution());
  for (const glm::vec3& normal : special_normals()) {
    EXPECT_EQ(cells.cell(normal, -0.5f), cells.cell(normal, 0));
    EXPECT_EQ(cells.cell(normal, 1.5f), cells.cell(normal, 1));
  }
}

// Every used cell is the cell of the plane in its middle, so none is there for nothing.
TEST_P(PlaneCellsOf, AreAllReachable) {
  const PlaneCells cells(addressing(), resolution());
  std::uint32_t used_count = 0;
  for (std::uint32_t i = 0; i < cells.cell_count(); ++i) {
    const PlaneCell cell = cells.geometry(i);
    if (!cell.is_used) continue;
    ++used_count;
    ASSERT_NEAR(glm::length(cell.axis), 1, 1e-6f);
    ASSERT_TRUE(i == cells.cell(cell.axis, cell.distance) || i == cells.edge_cell(cell.axis)) << i;
  }
  // The cube's middle holds no planes.
  const double expected = addressing() == PlaneAddressing::cube ? 1 - std::pow(0.125, 3) : 1.0;
  EXPECT_NEAR(static_cast<double>(used_count) / cells.cell_count(), expected, 2e-3);
}

// Tables of one resolution are of one size, whatever the addressing: else their errors could not be compared.
TEST_P(PlaneCellsOf, AreResolutionCubed) {
  const double cubed = std::pow(resolution(), 3);
  EXPECT_NEAR(PlaneCells(addressing(), resolution()).cell_count(), cubed, 0.06 * cubed);
}

}  // namespace
}  // namespace lkao::lut
