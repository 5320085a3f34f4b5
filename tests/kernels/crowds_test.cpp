// Scenes that keep a traversal busy: many boxes that rays meet in vain, deep hierarchies, small triangles among large
// ones, closed surfaces.
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "needles.h"
#include "ray_counts.h"
#include "same_bits.h"

namespace lkao::tests {
namespace {

class Crowds : public testing::TestWithParam<int> {
 protected:
  const SamplePattern& pattern() const { return SamplePattern::standard(GetParam()); }

  void add_triangle(Mesh& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const auto first = static_cast<unsigned>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c});
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  // Long, thin and askew: their boxes are full of rays that miss them.
  Mesh wires(int count, float thickness) {
    Mesh mesh;
    for (int i = 0; i < count; ++i) {
      const glm::vec3 start = random_point(random_, 1), end = start + random_direction(random_);
      add_triangle(mesh, start, end, end + thickness * random_direction(random_));
    }
    return mesh;
  }
  std::vector<Receiver> receivers(int count, float half_size) {
    std::vector<Receiver> all;
    for (int i = 0; i < count; ++i) {
      all.push_back({.position = random_point(random_, half_size), .normal = random_direction(random_)});
    }
    return all;
  }
  lut::RandomStream random_{51};
};

INSTANTIATE_TEST_SUITE_P(Rays, Crowds, ray_counts({64, 256, 1024}), testing::PrintToStringParamName());

// More pairs of a ray and a box than anyone has room for at a time.
TEST_P(Crowds, OfWiresAreAnsweredForEveryRay) {
  const Mesh mesh = wires(3000, 1e-3f);
  for (const bool spatial_splits : {false, true}) {
    for (const float radius : {0.3f, 4.0f}) {
      EXPECT_GT(expect_same_bits(mesh, pattern(), {.radius = radius}, receivers(3, 1), {spatial_splits}), 0u);
    }
  }
}

// Each scale of triangles holds the next, a thousandth of a millionth as large in the end.
TEST_P(Crowds, OfNestedScalesAreAnsweredForEveryRay) {
  Mesh mesh;
  for (int scale = 0; scale < 60; ++scale) {
    for (int i = 0; i < 24; ++i) {
      const float size = std::exp2(-0.5f * static_cast<float>(scale));
      const glm::vec3 place = size * random_direction(random_);
      add_triangle(mesh, place, place + 0.1f * size * random_direction(random_),
                   place + 0.1f * size * random_direction(random_));
    }
  }
  for (const float radius : {1e-6f, 1e-3f, 1.0f, 1e3f}) {
    std::vector<Receiver> near = receivers(8, 0.1f * radius);
    near[0].position = glm::vec3(0);
    EXPECT_GT(expect_same_bits(mesh, pattern(), {.radius = radius, .surface_offset = 0}, near), 0u) << radius;
  }
}

// Grass before walls: next to large triangles that many rays meet, small ones that few do.
TEST_P(Crowds, OfSmallTrianglesAmongLargeOnesAreAnsweredForEveryRay) {
  Mesh mesh = random_soup(2000, 0.02f, 52);
  const Mesh large = random_soup(12, 0.7f, 53);
  for (const glm::uvec3& t : large.triangles) {
    add_triangle(mesh, large.positions[t.x], large.positions[t.y], large.positions[t.z]);
  }
  add_quad(mesh, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0});
  const OccluderBvh occluders(mesh.view());
  std::uint64_t blocked_count = 0;
  for (const float radius : {0.1f, 0.5f, 5.0f}) {
    for (const Sidedness sidedness : {Sidedness::two_sided, Sidedness::one_sided}) {
      std::vector<Receiver> asked = receivers(GetParam() < 1024 ? 10 : 3, 1);
      for (Receiver& receiver : asked) receiver.excluded_primitive = 2000;
      const RayOptions options{.radius = radius, .sidedness = sidedness};
      blocked_count += expect_same_bits(mesh, pattern(), options, asked);
      expect_scalar_bits({{{occluders, 0, 0.3f * radius}, {occluders, 0.5f * radius}}, pattern(), options, asked});
    }
  }
  EXPECT_GT(blocked_count, 100u);
}

// From inside, near the wall and far from it, all rays are blocked: with a radius beyond the wall, far beyond, and
// without end.
TEST_P(Crowds, InAClosedSurfaceLetNoRayOut) {
  Mesh mesh = random_soup(200, 0.02f, 54);
  for (glm::vec3& p : mesh.positions) p *= 0.5f;
  const Mesh sphere = closed_sphere(40, 20);
  const auto first = static_cast<unsigned>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), sphere.positions.begin(), sphere.positions.end());
  for (const glm::uvec3& t : sphere.triangles) mesh.triangles.push_back(t + first);
  for (const float radius : {2.1f, 50.0f, 1e5f, std::numeric_limits<float>::infinity()}) {
    std::vector<Receiver> inside = receivers(6, 0.5f);
    for (int i = 0; i < 6; ++i) inside.push_back({.position = 0.98f * random_direction(random_), .normal = {0, 1, 0}});
    const RayOptions options{.radius = radius, .surface_offset = 0};
    EXPECT_EQ(expect_same_bits(mesh, pattern(), options, inside),
              inside.size() * static_cast<std::uint64_t>(GetParam()));
  }
}

}  // namespace
}  // namespace lkao::tests
