// Built-in scenes: counts, determinism, soundness, and that the halls are closed.
#include "scene/builtin.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <stdexcept>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "scene/defects.h"
#include "scene/shapes.h"

namespace lkao::scene {
namespace {

// FNV-1a over the bits of a mesh.
std::uint64_t hash_of(const Mesh& mesh) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&hash](const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 0x100000001b3u;
  };
  add(mesh.positions.data(), mesh.positions.size() * sizeof(glm::vec3));
  add(mesh.triangles.data(), mesh.triangles.size() * sizeof(glm::uvec3));
  return hash;
}

// Six times the volume inside a closed mesh; positive where the fronts look outwards.
double volume(const Mesh& mesh) {
  double sum = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    sum += glm::dot(glm::dvec3(mesh.positions[t.x]),
                    glm::cross(glm::dvec3(mesh.positions[t.y]), glm::dvec3(mesh.positions[t.z])));
  }
  return sum / 6;
}

TEST(Shapes, UnitCircleIsAccurate) {
  for (int i = -50; i < 150; ++i) {
    const double turns = i / 96.0;
    const glm::dvec2 p = unit_circle(turns);
    EXPECT_NEAR(p.x, std::cos(turns * 6.283185307179586), 1e-14) << turns;
    EXPECT_NEAR(p.y, std::sin(turns * 6.283185307179586), 1e-14) << turns;
  }
  EXPECT_EQ(unit_circle(0.25), glm::dvec2(0, 1));
}

TEST(Shapes, FrontsOfSolidsLookOutwards) {
  Mesh box;
  add_box(box, {1, 2, 3}, {3, 5, 7});
  EXPECT_NEAR(volume(box), 24, 1e-5);
  Mesh sphere;
  add_sphere(sphere, {5, 0, 0}, 1, 128, 64);
  EXPECT_NEAR(volume(sphere), 4.18879, 0.01);
  Mesh bar;
  const Station path[] = {{{0, 0, 9}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 4}, {1, 0, 0}, {0, 1, 0}}};
  const glm::dvec2 section[] = {{0, 0}, {2, 0}, {2, 1}, {0, 1}};
  add_swept(bar, path, section);
  EXPECT_NEAR(volume(bar), 10, 1e-5);
}

TEST(Shapes, ReliefsAreClosedBetweenTheirSteps) {
  // The areas of all faces, projected on each axis, must cancel but for the outline: no wall is missing or turned.
  Mesh mesh;
  const double us[] = {0, 1, 2, 3};
  const double vs[] = {0, 1, 2, 3};
  add_relief(
      mesh, us, vs, [](std::size_t i, std::size_t j) { return i == 1 && j == 1 ? -0.5 : 0.0; },
      [](double u, double v, double h) { return glm::dvec3(u, v, h); });
  glm::dvec3 sum(0.0);
  double area = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]);
    const glm::dvec3 twice = glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a);
    sum += 0.5 * twice;
    area += 0.5 * glm::length(twice);
  }
  EXPECT_NEAR(glm::length(sum - glm::dvec3(0, 0, 9)), 0, 1e-6);
  EXPECT_NEAR(area, 9 + 4 * 0.5, 1e-6);
}

TEST(Builtin, UnknownNamesAreRefusedWithTheKnownOnes) {
  try {
    make_builtin("palace");
    FAIL();
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("palace"), std::string::npos);
    for (const BuiltinScene& scene : builtin_scenes()) EXPECT_NE(message.find(scene.name), std::string::npos);
  }
}

struct Expected {
  const char* name;
  std::size_t least;
  std::size_t most;
  std::uint64_t hash;
};

// The name of the scene alone: the tests' names must not hold addresses.
void PrintTo(const Expected& expected, std::ostream* out) { *out << expected.name; }

class BuiltinScenes : public testing::TestWithParam<Expected> {};

TEST_P(BuiltinScenes, HaveTheirSizeAndTheSameBitsEverywhere) {
  const Expected& expected = GetParam();
  const Mesh mesh = make_builtin(expected.name);
  EXPECT_GE(mesh.triangles.size(), expected.least);
  EXPECT_LE(mesh.triangles.size(), expected.most);
  EXPECT_EQ(hash_of(mesh), expected.hash) << std::hex << "0x" << hash_of(mesh);
  for (const glm::uvec3& t : mesh.triangles) {
    ASSERT_LT(std::max({t.x, t.y, t.z}), mesh.positions.size());
  }
}

// The scene, the hairball with fewer hairs: the same code in a tenth of the time.
Mesh make_lighter(const std::string& name) { return name == "hairball" ? make_hairball(200'000) : make_builtin(name); }

TEST_P(BuiltinScenes, HaveNoDefects) {
  const Defects defects = find_defects(make_lighter(GetParam().name));
  EXPECT_EQ(defects.zero_area_count, 0u);
  EXPECT_EQ(defects.non_finite_count, 0u);
  EXPECT_EQ(defects.duplicate_count, 0u);
  EXPECT_EQ(defects.unused_vertex_count, 0u);
}

TEST_P(BuiltinScenes, AreSeenByTheirCamera) {
  const BuiltinScene& scene = builtin_scene(GetParam().name);
  const ReceiverImage image = find_receivers(make_lighter(scene.name), scene.camera, 64, 48);
  EXPECT_GT(image.receiver_count, 64u * 48u / 4);
}

INSTANTIATE_TEST_SUITE_P(All, BuiltinScenes,
                         testing::Values(Expected{"plane", 2, 2, 0x194a71e46c1568a7},
                                         Expected{"box", 12, 12, 0x3b03340ae4113c95},
                                         Expected{"wall", 4, 4, 0x6a9e41a81ebc2d95},
                                         Expected{"disk", 514, 514, 0x7c3257fc739787ca},
                                         Expected{"sphere", 60000, 70000, 0x8fe378dd7dd82c8c},
                                         Expected{"atrium", 60000, 400000, 0xed54b953ddbc88e5},
                                         Expected{"city", 860000, 900000, 0xb4431177237f7773},
                                         Expected{"hairball", 2879000, 2881000, 0xc26753ba8983e5d3}),
                         [](const testing::TestParamInfo<Expected>& scene) { return std::string(scene.param.name); });

TEST(Hairball, HasAboutTheTrianglesAskedFor) {
  for (std::size_t count : {std::size_t{5000}, std::size_t{100'000}}) {
    const Mesh mesh = make_hairball(count);
    EXPECT_NEAR(static_cast<double>(mesh.triangles.size()), static_cast<double>(count), 240);
    for (const glm::vec3& p : mesh.positions) ASSERT_LT(glm::length(p), 5.5f);
  }
}

TEST(Atrium, TrianglesAreOfVeryUnevenSize) {
  const Mesh mesh = make_atrium();
  double largest = 0;
  std::size_t small_count = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]);
    const double area =
        0.5 * glm::length(glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a));
    largest = std::max(largest, area);
    if (area < 0.001) ++small_count;
  }
  EXPECT_GT(largest, 50);
  EXPECT_GT(small_count, 30000u);
}

TEST(Atrium, IsAClosedRoom) {
  // From several places, every pixel of wide views sees a wall.
  const Mesh mesh = make_atrium();
  const glm::vec3 eyes[] = {{-13.4f, 2.5f, 1.5f}, {13.8f, 2.6f, 2}, {0, 2, -5.5f}};
  const glm::vec3 directions[] = {{1, 0, 0.1f}, {-1, 0, 0.1f}, {0, -1, 0}};
  for (const glm::vec3& eye : eyes) {
    for (const glm::vec3& direction : directions) {
      const glm::vec3 up = direction.y == 0 ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
      const ReceiverImage image = find_receivers(mesh, {eye, eye + direction, up, 150}, 400, 400);
      ASSERT_EQ(image.receiver_count, 400u * 400u)
          << "leaks towards " << direction.x << " " << direction.y << " " << direction.z;
    }
  }
}

}  // namespace
}  // namespace lkao::scene
