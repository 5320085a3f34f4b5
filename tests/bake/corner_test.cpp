#include "bake/corner_receivers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "bake/meshes.h"
#include "scene/shapes.h"

namespace lkao::bake {
namespace {

constexpr NormalSource kWithoutFile[] = {NormalSource::facet, NormalSource::smooth};

void expect_all(const std::vector<float>& values, float expected) {
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(values[i], expected) << "vertex " << i;
}

TEST(CornerBake, AClosedRoomIsWhollyDark) {
  for (const NormalSource source : kWithoutFile) {
    for (const Per per : {Per::vertex, Per::corner}) {
      Mesh split = split_room(), shared = joined(split);
      expect_all(bake_corners(split, source, per), 1);
      expect_all(bake_corners(shared, source, per), 1);
      EXPECT_EQ(shared.positions.size(), 8u);
    }
  }
}

// Where rounding is coarsest: a small room far from zero.
TEST(CornerBake, AClosedRoomFarAwayIsWhollyDark) {
  Mesh mesh = split_room({1, 1, 1});
  for (glm::vec3& p : mesh.positions) p += glm::vec3(1000, -2000, 500);
  expect_all(bake_corners(mesh, NormalSource::facet), 1);
}

TEST(CornerBake, ASphereOfFacetsSeesNothingOfItself) {
  for (const NormalSource source : kWithoutFile) {
    Mesh outside;
    scene::add_sphere(outside, {1, 2, 3}, 2, 24, 12);
    expect_all(bake_corners(outside, source), 0);
  }
}

// A floor that goes on behind the wall on it: from either side the wall hides half of what each vertex at its foot
// sees.
TEST(CornerBake, TheFootOfAWallIsHalfDark) {
  Mesh mesh;
  mesh.positions = {{-1, 0, -1}, {0, 0, -1}, {1, 0, -1}, {-1, 0, 1}, {0, 0, 1}, {1, 0, 1}};
  mesh.triangles = {{0, 3, 4}, {0, 4, 1}, {1, 4, 5}, {1, 5, 2}};
  add_quad(mesh, {{0, 0, -1000}, {0, 0, 1000}, {0, 1000, 1000}, {0, 1000, -1000}});
  const std::vector<float> values = bake_corners(mesh, NormalSource::facet);
  EXPECT_NEAR(values[1], 0.5, 0.01);
  EXPECT_NEAR(values[4], 0.5, 0.01);
}

// Without the wall's cleared distance a leaning wall would let light through at its foot.
TEST(CornerBake, UnderALeaningWallIsDark) {
  for (const float degrees : {60.0f, 30.0f, 10.0f, 5.0f}) {
    const double angle = degrees * std::numbers::pi / 180;
    const float c = static_cast<float>(100 * std::cos(angle)), s = static_cast<float>(100 * std::sin(angle));
    Mesh mesh;
    add_quad(mesh, {{0, 0, -1}, {0, 0, 1}, {1, 0, 1}, {1, 0, -1}});
    add_quad(mesh, {{0, 0, -100}, {0, 0, 100}, {c, s, 100}, {c, s, -100}});
    const std::vector<float> values = bake_corners(mesh, NormalSource::facet);
    EXPECT_NEAR(values[0], 0.5 + 0.5 * std::cos(angle), 0.02) << degrees;
  }
}

// Under a roof lies a leaf whose back has vertices of its own, or the same ones.
TEST(CornerBake, ALeafHasTwoSides) {
  for (const NormalSource source : kWithoutFile) {
    Mesh mesh;
    add_quad(mesh, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    add_quad(mesh, {{0, 1, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, 0}});
    add_quad(mesh, {{-50, -50, 1}, {-50, 50, 1}, {50, 50, 1}, {50, -50, 1}});
    const std::vector<float> values = bake_corners(mesh, source);
    ASSERT_EQ(values.size(), 12u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_GT(values[i], 0.99f) << i;
    for (std::size_t i = 4; i < 12; ++i) EXPECT_EQ(values[i], 0) << i;
  }
  Mesh shared;
  add_quad(shared, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  shared.triangles.insert(shared.triangles.end(), {{0, 2, 1}, {0, 3, 2}});
  add_quad(shared, {{-50, -50, 1}, {-50, 50, 1}, {50, 50, 1}, {50, -50, 1}});
  const std::vector<float> values = bake_corners(shared, NormalSource::facet, Per::corner);
  ASSERT_EQ(values.size(), 12u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_GT(values[i], 0.99f) << i;
  for (std::size_t i = 4; i < 12; ++i) EXPECT_EQ(values[i], 0) << i;
}

// A valley, cut in two along its bottom: the halves agree there bit for bit.
TEST(CornerBake, ASeamHasNoStep) {
  Mesh mesh;
  add_quad(mesh, {{-1, 0.2f, 1}, {0, 0, 1}, {0, 0, -1}, {-1, 0.2f, -1}});
  add_quad(mesh, {{0, 0, 1}, {1, 0.4f, 1}, {1, 0.4f, -1}, {0, 0, -1}});
  for (const NormalSource source : kWithoutFile) {
    Mesh copy = mesh;
    const std::vector<float> values = bake_corners(copy, source);
    EXPECT_EQ(values[1], values[4]);
    EXPECT_EQ(values[2], values[7]);
    EXPECT_GT(values[1], 0);
  }
}

// A step under a roof: its top is dark, and its side, which sees the ground too, half as much.
TEST(CornerBake, CreasesKeepTheirValues) {
  Mesh mesh;
  add_quad(mesh, {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}});
  add_quad(mesh, {{0, 0, 0}, {0, -9, 0}, {0, -9, 1}, {0, 0, 1}});
  add_quad(mesh, {{-100, 1, -100}, {100, 1, -100}, {100, 1, 100}, {-100, 1, 100}});
  Mesh shared = joined(mesh), corners = shared;
  const std::vector<float> split = bake_corners(mesh, NormalSource::facet);
  EXPECT_NEAR(split[0], 1, 0.02);
  EXPECT_NEAR(split[4], 0.5, 0.02);
  const std::vector<float> one = bake_corners(shared, NormalSource::facet);
  EXPECT_EQ(one.size(), 10u);
  EXPECT_GT(one[0], 0.6f);
  EXPECT_LT(one[0], 0.9f);
  const std::vector<float> own = bake_corners(corners, NormalSource::facet, Per::corner);
  EXPECT_EQ(own.size(), 12u);
  EXPECT_EQ(own[0], split[0]);
}

// The file says that the front of this floor is above, whatever the order of its corners.
TEST(CornerBake, NormalsOfTheFileSayWhichSideIsInFront) {
  Mesh mesh;
  add_quad(mesh, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  mesh = turned(mesh);
  add_quad(mesh, {{-50, -50, 1}, {-50, 50, 1}, {50, 50, 1}, {50, -50, 1}});
  Mesh without = mesh;
  EXPECT_EQ(bake_corners(without, NormalSource::facet)[0], 0);
  mesh.normals = {{0, 0, 1}, {0, 0, -1}};
  mesh.normal_corners = {glm::uvec3(0), glm::uvec3(0), glm::uvec3(1), glm::uvec3(1)};
  EXPECT_GT(bake_corners(mesh, NormalSource::file)[0], 0.99f);
}

TEST(CornerBake, VerticesWithoutTrianglesHaveNoValue) {
  Mesh mesh;
  mesh.positions = {{5, 5, 5}};
  add_quad(mesh, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const std::vector<float> values = bake_corners(mesh, NormalSource::facet);
  ASSERT_EQ(values.size(), 5u);
  EXPECT_TRUE(std::isnan(values[0]));
  for (std::size_t i = 1; i < 5; ++i) EXPECT_EQ(values[i], 0);
}

// The needle is too thin for a receiver to get away from its edges: what it says counts where nothing else is known.
TEST(CornerBake, SliversDoNotSpoilAVertex) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {0.5f, 0, 1e-7f}};
  mesh.triangles = {{0, 4, 1}, {0, 3, 2}, {0, 2, 4}, {4, 2, 1}};
  std::vector<float> occlusion(12, 1);
  std::fill_n(occlusion.begin(), 3, 0.25f);
  const auto values = [&] {
    const Places places = make_places(CornerNormals(mesh, NormalSource::facet), Per::vertex);
    Mesh split = mesh;
    return split_vertices(split, places, average_at_places(mesh, places, occlusion, scene::bounds_of(mesh)));
  };
  expect_all(values(), 1);
  mesh.triangles.resize(1);
  EXPECT_EQ(values()[0], 0.25f);
}

}  // namespace
}  // namespace lkao::bake
