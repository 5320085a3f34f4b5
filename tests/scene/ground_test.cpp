#include "scene/ground.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "bvh/usable_triangle.h"
#include "scene/builtin.h"

namespace lkao::scene {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

glm::dvec3 area_of(const Mesh& mesh, std::size_t triangle) {
  const glm::uvec3& t = mesh.triangles[triangle];
  return bvh::area_vector(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]);
}

double diagonal_of(const Mesh& mesh) {
  const Bounds box = bounds_of(mesh);
  return glm::distance(glm::dvec3(box.lower), glm::dvec3(box.upper));
}

TEST(Ground, LiesJustBelowTheLowestPointAndFacesUp) {
  const Mesh sphere = make_sphere();
  const double diagonal = diagonal_of(sphere);
  for (const glm::vec3& up : {glm::vec3(0, 1, 0), glm::vec3(0, 0, -3), glm::vec3(1, 0, 0), glm::vec3(-1, 2, 0.5f)}) {
    const Mesh ground = make_ground(sphere, up, 0.5);
    const glm::dvec3 direction = glm::normalize(glm::dvec3(up));
    double lowest = kInfinity;
    for (const glm::vec3& p : sphere.positions) lowest = std::min(lowest, glm::dot(glm::dvec3(p), direction));
    for (const glm::vec3& p : ground.positions) {
      const double gap = lowest - glm::dot(glm::dvec3(p), direction);
      EXPECT_GT(gap, 0);
      EXPECT_NEAR(gap, 1e-4 * diagonal, 1e-6 * diagonal);
    }
    ASSERT_EQ(ground.triangles.size(), 2u);
    for (const std::size_t t : {0u, 1u}) {
      EXPECT_NEAR(glm::dot(glm::normalize(area_of(ground, t)), direction), 1, 1e-6);
    }
  }
}

TEST(Ground, ReachesAsFarAsTheRadius) {
  const Mesh sphere = make_sphere();  // on a floor that is wider than it is high
  const double diagonal = diagonal_of(sphere);
  const auto half_side = [&](double radius) {
    const Bounds box = bounds_of(make_ground(sphere, {0, 1, 0}, radius));
    return 0.5 * (double{box.upper.x} - double{box.lower.x});
  };
  const Bounds box = bounds_of(sphere);
  const double half_width = 0.5 * (double{box.upper.x} - double{box.lower.x});
  EXPECT_NEAR(half_side(1e-3), half_width + diagonal, 1e-5 * diagonal);
  EXPECT_NEAR(half_side(7 * diagonal), half_width + 7 * diagonal, 1e-5 * diagonal);
  EXPECT_NEAR(half_side(kInfinity), half_width + kGroundReach * diagonal, 1e-4 * diagonal);
}

TEST(Ground, HasTheOriginOfTheMesh) {
  Mesh box = make_box();
  box.origin = {448262, 5413678, 0};
  EXPECT_EQ(make_ground(box, {0, 1, 0}, 1).origin, box.origin);
}

TEST(Ground, NeedsAnUpAndSomethingToStandOnIt) {
  EXPECT_THROW(make_ground(make_box(), {0, 0, 0}, 1), std::invalid_argument);
  EXPECT_THROW(make_ground({}, {0, 1, 0}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace lkao::scene
