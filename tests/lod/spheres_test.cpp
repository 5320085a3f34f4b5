// Spheres of a mesh: they keep its surface, follow it, and are the same each time.
#include "lod/spheres.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "lod/meshes.h"
#include "lod/nearest_point.h"
#include "lod/triangle.h"

namespace lkao::lod {
namespace {

double area_of(const scene::Mesh& mesh) {
  double area = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    area += area_of(Triangle{mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]});
  }
  return area;
}

double surface_of(const std::vector<glm::vec4>& spheres) {
  double area = 0;
  for (const glm::vec4& sphere : spheres) area += 4 * std::numbers::pi * double{sphere.w} * double{sphere.w};
  return area;
}

// Two triangles that are large beside a ball of small ones.
scene::Mesh ball_on_floor() {
  scene::Mesh mesh = ball(0.3, 24);
  scene::add_quad(mesh, {-2, -0.3, 2}, {2, -0.3, 2}, {2, -0.3, -2}, {-2, -0.3, -2});
  return mesh;
}

double squared_error(const MeshSpheres& spheres, const scene::Mesh& mesh) {
  const std::vector<glm::vec4> centres = spheres.at(mesh.positions);
  double sum = 0;
  for (const SurfaceSample& sample : spheres.samples()) {
    const glm::uvec3 t = mesh.triangles[sample.triangle];
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    const glm::dvec3 off =
        a + sample.corner.x * (b - a) + sample.corner.y * (c - a) - glm::dvec3(centres[sample.sphere]);
    sum += sample.share * area_of(Triangle{a, b, c}) * glm::dot(off, off);
  }
  return sum;
}

TEST(NearestPoint, IsTheFirstOfTheNearest) {
  scene::Random random(3);
  const auto random_point = [&] {  // on a grid, so that many are equally near and some are the same
    return glm::floor(8.0 * glm::dvec3(random.uniform(), random.uniform(), 0.3 * random.uniform()));
  };
  for (const int count : {1, 2, 3, 100, 500}) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i < count; ++i) points.push_back(random_point());
    const NearestPoint nearest(points);
    for (int i = 0; i < 500; ++i) {
      const glm::dvec3 place = random_point() + (i % 2) * 0.5;
      const auto squared = [&](const glm::dvec3& p) { return glm::dot(p - place, p - place); };
      const auto best = std::min_element(points.begin(), points.end(), [&](const glm::dvec3& a, const glm::dvec3& b) {
        return squared(a) < squared(b);
      });
      ASSERT_EQ(nearest.to(place), static_cast<std::uint32_t>(best - points.begin()));
    }
  }
}

TEST(MeshSpheres, EveryTriangleIsInThemOnce) {
  const scene::Mesh mesh = ball_on_floor();
  const MeshSpheres spheres(mesh.view(), {.count = 200});
  std::vector<double> shares(mesh.triangles.size());
  std::uint32_t last = 0;
  for (const SurfaceSample& sample : spheres.samples()) {
    shares[sample.triangle] += sample.share;
    EXPECT_GE(std::min({sample.corner.x, sample.corner.y, 1 - sample.corner.x - sample.corner.y}), -1e-9);
    EXPECT_LE(sample.sphere - last, 1u) << "a gap in the numbers, or not in order";
    last = sample.sphere;
  }
  for (const double share : shares) EXPECT_NEAR(share, 1, 1e-9);
  EXPECT_EQ(last + 1, spheres.count());
}

TEST(MeshSpheres, SmallTrianglesStayWhole) {
  const scene::Mesh mesh = ball(0.3, 48);
  const MeshSpheres spheres(mesh.view(), {.count = 50});
  EXPECT_EQ(spheres.count(), 50u);
  EXPECT_EQ(spheres.samples().size(), mesh.triangles.size());
}

TEST(MeshSpheres, KeepTheSurface) {
  for (const int count : {1, 7, 300, 3000}) {
    for (const scene::Mesh& mesh : {ball_on_floor(), wavy_grid(20)}) {
      const MeshSpheres spheres(mesh.view(), {.count = count});
      const std::vector<glm::vec4> found = spheres.at(mesh.positions);
      ASSERT_EQ(found.size(), spheres.count());
      EXPECT_LE(found.size(), static_cast<std::size_t>(count));
      EXPECT_GE(found.size(), static_cast<std::size_t>(0.9 * count));
      EXPECT_NEAR(surface_of(found) / area_of(mesh), 1, 1e-5);
    }
  }
}

TEST(MeshSpheres, OneIsTheBallThatItStandsFor) {
  const scene::Mesh mesh = ball(0.5, 64);
  const glm::vec4 sphere = MeshSpheres(mesh.view(), {.count = 1}).at(mesh.positions).at(0);
  EXPECT_NEAR(glm::length(glm::vec3(sphere)), 0, 1e-5);
  EXPECT_NEAR(sphere.w, 0.5, 0.002);
}

TEST(MeshSpheres, AreOfAboutOneSize) {
  const scene::Mesh mesh = ball_on_floor();
  const std::vector<glm::vec4> spheres = MeshSpheres(mesh.view(), {.count = 400}).at(mesh.positions);
  const auto [smallest, largest] = std::minmax_element(
      spheres.begin(), spheres.end(), [](const glm::vec4& a, const glm::vec4& b) { return a.w < b.w; });
  EXPECT_LT(largest->w / smallest->w, 3);
}

TEST(MeshSpheres, RoundsBringThemNearer) {
  const scene::Mesh mesh = ball_on_floor();
  double last = std::numeric_limits<double>::infinity();
  for (const int count : {0, 1, 4, 20}) {
    const double error = squared_error(MeshSpheres(mesh.view(), {.count = 100, .iteration_count = count}), mesh);
    EXPECT_LT(error, last);
    last = error;
  }
  // Each sample is with the nearest centre where nothing changes any more.
  const MeshSpheres spheres(mesh.view(), {.count = 20, .iteration_count = 1000});
  const std::vector<glm::vec4> centres = spheres.at(mesh.positions);
  std::vector<glm::dvec3> points;
  for (const glm::vec4& centre : centres) points.emplace_back(centre);
  const NearestPoint nearest(points);
  std::size_t other_count = 0;
  for (const SurfaceSample& sample : spheres.samples()) {
    const glm::uvec3 t = mesh.triangles[sample.triangle];
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    other_count += nearest.to(a + sample.corner.x * (b - a) + sample.corner.y * (c - a)) != sample.sphere;
  }
  EXPECT_LE(other_count, 2u) << "centres are floats";
}

TEST(MeshSpheres, FollowAMeshThatDeforms) {
  scene::Mesh mesh = ball_on_floor();
  const MeshSpheres spheres(mesh.view(), {.count = 100});
  const std::vector<glm::vec4> before = spheres.at(mesh.positions);
  // A similarity moves them as it moves the mesh.
  const auto turn = [](const glm::vec3& p) { return 2.0f * glm::vec3(p.z, p.y, -p.x) + glm::vec3(1, 2, 3); };
  std::vector<glm::vec3> turned = mesh.positions;
  for (glm::vec3& p : turned) p = turn(p);
  const std::vector<glm::vec4> after = spheres.at(turned);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(glm::distance(glm::vec3(after[i]), turn(glm::vec3(before[i]))), 0, 1e-5);
    EXPECT_NEAR(after[i].w, 2 * before[i].w, 1e-6);
  }
  // Anything else: each stands for what it stood for.
  for (glm::vec3& p : mesh.positions) p.y += 0.8f * std::sin(3 * p.x) * p.z;
  const std::vector<glm::vec4> bent = spheres.at(mesh.positions);
  EXPECT_NEAR(surface_of(bent) / area_of(mesh), 1, 1e-5);
  EXPECT_GT(surface_of(bent), 1.02 * surface_of(before));
  // What is gone blocks nothing.
  std::vector<glm::vec3> point(mesh.positions.size(), glm::vec3(1));
  for (const glm::vec4& sphere : spheres.at(point)) EXPECT_EQ(sphere.w, 0);
}

TEST(MeshSpheres, AreTheSameForAnyNumberOfThreads) {
  const scene::Mesh mesh = wavy_grid(80);  // of 12,800 triangles: several parts at a time
  std::vector<std::vector<glm::vec4>> all;
  for (const int thread_count : {1, 2}) {
    tbb::task_arena(thread_count).execute([&] {
      all.push_back(MeshSpheres(mesh.view(), {.count = 500}).at(mesh.positions));
    });
  }
  EXPECT_EQ(all[1], all[0]);
}

TEST(MeshSpheres, LeaveOutWhatBlocksNothing) {
  scene::Mesh mesh = ball(0.3, 8);
  const std::size_t usable_count = mesh.triangles.size();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  mesh.positions.insert(mesh.positions.end(), {{nan, 0, 0}, {1e19f, 0, 0}});
  const auto last = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.triangles.insert(mesh.triangles.end(), {{0, 1, last - 2}, {0, 1, last - 1}, {0, 1, 1}});
  const MeshSpheres spheres(mesh.view(), {.count = 20});
  for (const SurfaceSample& sample : spheres.samples()) EXPECT_LT(sample.triangle, usable_count);
  for (const glm::vec4& sphere : spheres.at(mesh.positions)) EXPECT_LT(glm::length(glm::vec3(sphere)), 0.31);
  EXPECT_EQ(MeshSpheres(TriangleMesh{}).count(), 0u);
  EXPECT_TRUE(MeshSpheres(TriangleMesh{}).at({}).empty());
}

TEST(MeshSpheres, RefuseWhatIsWrong) {
  const scene::Mesh mesh = ball(0.3, 8);
  EXPECT_THROW(MeshSpheres(mesh.view(), {.count = 0}), std::invalid_argument);
  EXPECT_THROW(MeshSpheres(mesh.view(), {.iteration_count = -1}), std::invalid_argument);
  const std::vector<glm::uvec3> beyond{{0, 1, 1000}};
  EXPECT_THROW(MeshSpheres(TriangleMesh{mesh.positions, beyond}), std::invalid_argument);
  EXPECT_THROW((void)MeshSpheres(mesh.view()).at({}), std::invalid_argument);
}

}  // namespace
}  // namespace lkao::lod
