#include "lod/near_cells.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include "lod/meshes.h"

namespace lkao::lod {
namespace {

// Around the waves and beyond their box, with many close to the distance itself.
std::vector<glm::dvec3> points_around(double distance) {
  scene::Random random(7);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 20'000; ++i) {
    const double x = random.uniform(-0.2, 1.2), z = random.uniform(-0.2, 1.2);
    const double surface = 0.05 * std::sin(9 * x) * std::cos(7 * z);
    points.emplace_back(x, surface + random.uniform(-2 * distance, 2 * distance), z);
    points.emplace_back(x, surface + distance * random.uniform(0.99, 1.01), z);
  }
  points.insert(points.end(), {{-50, 0, 0}, {1e9, 0, 0}, {-1e9, 1e9, 1e30}});
  return points;
}

TEST(NearCells, AnswerAsTheSurfaceDoes) {
  const scene::Mesh mesh = wavy_grid(30);
  const Surface surface(mesh);
  for (const double distance : {0.003, 0.02, 0.3}) {
    const std::vector<glm::dvec3> points = points_around(distance);
    // With room for all cells, and for so few that they keep driving each other out.
    for (const std::size_t cell_count : {std::size_t{1} << 20, std::size_t{1}}) {
      const NearCells cells(surface, distance, {0, -0.05, 0}, cell_count);
      std::size_t within_count = 0;
      for (const glm::dvec3& p : points) {
        const bool is_within = cells.is_within(p);
        ASSERT_EQ(is_within, surface.is_within(p, distance)) << p.x << ' ' << p.y << ' ' << p.z;
        EXPECT_EQ(cells.is_within(p), is_within) << "the second time";
        within_count += is_within;
      }
      EXPECT_GT(within_count, points.size() / 10);
      EXPECT_LT(within_count, points.size() * 9 / 10);
    }
  }
}

TEST(NearCells, AnswerSeveralThreads) {
  const scene::Mesh mesh = wavy_grid(30);
  const Surface surface(mesh);
  const double distance = 0.02;
  const std::vector<glm::dvec3> points = points_around(distance);
  const NearCells cells(surface, distance, {0, -0.05, 0}, 1);
  std::vector<std::uint8_t> answers(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) { answers[i] = cells.is_within(points[i]); });
  for (std::size_t i = 0; i < points.size(); ++i) ASSERT_EQ(answers[i] != 0, surface.is_within(points[i], distance));
}

}  // namespace
}  // namespace lkao::lod
