#include "bake/texture_layout.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bake/texture_charts.h"
#include "bake/texture_meshes.h"

namespace lkao::bake {
namespace {

using testing::HasSubstr, testing::ThrowsMessage;

// A triangle of the floor with these texture coordinates.
void add_floor(Mesh& mesh, const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
  add_uv_triangle(mesh, {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}}, {a, b, c});
}

struct Laid {
  CornerNormals normals;
  TextureLayout layout;

  explicit Laid(const Mesh& mesh, const TextureOptions& options = {})
      : normals(mesh, scene::usual_normals(mesh)), layout(normals, options) {}
};

TEST(TextureLayout, CountsWhatItCannotOrMayNotBake) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Mesh mesh;
  add_floor(mesh, {0, 0}, {0, 1}, {1, 1});        // as seen from its front
  add_floor(mesh, {1, 0}, {1, 1}, {0, 1});        // mirrored
  add_floor(mesh, {0, 0}, {0.5f, 0.5f}, {1, 1});  // a line
  add_floor(mesh, {0, 0}, {nan, 1}, {1, 1});
  add_bare_quad(mesh, {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}});
  add_uv_triangle(mesh, {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0, 0}, {0, 1}, {1, 1}});
  const Laid laid(mesh);
  const TextureReport& report = laid.layout.report();
  EXPECT_EQ(report.triangle_count, 7u);
  EXPECT_EQ(report.bare_triangle_count, 3u);
  EXPECT_EQ(report.flat_triangle_count, 2u);
  EXPECT_EQ(report.mirrored_triangle_count, 1u);
  EXPECT_FALSE(laid.layout.is_mirrored(0));
  EXPECT_TRUE(laid.layout.is_mirrored(1));
  for (std::uint32_t t = 0; t < 7; ++t) EXPECT_EQ(laid.layout.has(t), t < 2) << t;
}

// The front is where the file's normals say it is.
TEST(TextureLayout, AMirrorIsSeenFromTheFront) {
  Mesh mesh;
  add_floor(mesh, {0, 0}, {0, 1}, {1, 1});
  mesh.normals = {{0, -1, 0}};
  mesh.normal_corners = {glm::uvec3(0)};
  EXPECT_TRUE(Laid(mesh).layout.is_mirrored(0));
}

TEST(TextureLayout, RefusesAMeshWithoutTextureCoordinates) {
  Mesh mesh;
  add_quad(mesh, {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}});
  EXPECT_THAT([&] { Laid{mesh}; }, ThrowsMessage<std::invalid_argument>(HasSubstr("no texture coordinates")));
  mesh.uv_corners.assign(2, glm::uvec3(scene::kNoUv));
  EXPECT_THAT([&] { Laid{mesh}; }, ThrowsMessage<std::invalid_argument>(HasSubstr("no triangle to bake has texture")));
  add_floor(mesh, {0, 0}, {0, 1}, {1, 1});
  EXPECT_NO_THROW(Laid{mesh});
  EXPECT_THAT([&] { (Laid{mesh, {.material = 3}}); }, ThrowsMessage<std::invalid_argument>(HasSubstr("no triangle")));
  EXPECT_THAT(
      [&] {
        (Laid{mesh, {.width = 0}});
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("width must be 1 to 32768, not 0")));
  EXPECT_THAT([&] { (Laid{mesh, {.edge_grid = 17}}); }, ThrowsMessage<std::invalid_argument>(HasSubstr("edge_grid")));
}

TEST(TextureLayout, TakesOneMaterialAlone) {
  Mesh mesh;
  for (int i = 0; i < 3; ++i) add_floor(mesh, {0, 0}, {0, 1}, {1, 1});
  mesh.materials = {4, scene::kNoMaterial, 7};
  const Laid laid(mesh, {.material = 7});
  EXPECT_EQ(laid.layout.report().triangle_count, 1u);
  EXPECT_TRUE(laid.layout.has(2));
  EXPECT_FALSE(laid.layout.has(0) || laid.layout.has(1));
}

// As DamagedHelmet: v in [1, 2].
TEST(TextureLayout, WhatLiesOutsideIsWhereTheSamplerShowsIt) {
  Mesh mesh;
  add_floor(mesh, {0.25f, 1.5f}, {0.25f, 1.75f}, {0.5f, 1.75f});
  const Laid repeated(mesh, {.width = 64, .height = 32});
  const std::vector<Placement> placements = repeated.layout.placements(0, 0, 32);
  ASSERT_EQ(placements.size(), 1u);
  EXPECT_EQ(repeated.layout.corners(placements[0])[0], glm::dvec2(16, 16));
  EXPECT_EQ(repeated.layout.corners(placements[0])[2], glm::dvec2(32, 24));
  EXPECT_TRUE(repeated.layout.placements(0, 0, 16).empty());

  const Laid mirrored(mesh, {.width = 64, .height = 32, .wrap_v = Wrap::mirror});
  EXPECT_EQ(mirrored.layout.corners(mirrored.layout.placements(0, 0, 32).at(0))[2], glm::dvec2(32, 8));

  const Laid clamped(mesh, {.width = 64, .height = 32, .wrap_v = Wrap::clamp});
  EXPECT_TRUE(clamped.layout.placements(0, 0, 32).empty());
  EXPECT_EQ(clamped.layout.report().outside_triangle_count, 1u);
  EXPECT_EQ(repeated.layout.report().outside_triangle_count, 0u);
}

TEST(TextureLayout, ATriangleOverTwoSquaresIsInBoth) {
  Mesh mesh;
  add_floor(mesh, {0.5f, 0.25f}, {0.5f, 0.5f}, {1.5f, 0.5f});
  const Laid laid(mesh, {.width = 64, .height = 64});
  const std::vector<Placement> placements = laid.layout.placements(0, 0, 64);
  ASSERT_EQ(placements.size(), 2u);
  EXPECT_EQ(laid.layout.corners(placements[1])[2], glm::dvec2(32, 32));
}

TEST(TextureLayout, AWideTriangleIsBakedAFewTimes) {
  Mesh mesh;
  add_floor(mesh, {0, 0}, {0, 100}, {100, 100});
  const Laid laid(mesh);
  EXPECT_EQ(laid.layout.report().wide_triangle_count, 1u);
  EXPECT_EQ(laid.layout.placements(0, 0, 1024).size(), 64u);
}

// v upwards begins at the lower end of tile 1001.
TEST(TextureLayout, UdimTilesAreMapsByNumber) {
  Mesh mesh;
  add_floor(mesh, {0.25f, 0.25f}, {0.25f, 0.75f}, {0.75f, 0.75f});
  add_floor(mesh, {3.25f, -0.75f}, {3.25f, -0.25f}, {3.75f, -0.25f});
  add_floor(mesh, {0.25f, 1.25f}, {0.25f, 1.75f}, {0.75f, 1.75f});  // below all tiles
  const Laid laid(mesh, {.width = 64, .height = 64, .udim = true});
  EXPECT_EQ(laid.layout.udims(), (std::vector<int>{1001, 1014}));
  EXPECT_EQ(laid.layout.report().outside_triangle_count, 1u);
  ASSERT_EQ(laid.layout.placements(0, 0, 64).size(), 1u);
  const std::vector<Placement> second = laid.layout.placements(1, 0, 64);
  ASSERT_EQ(second.size(), 1u);
  EXPECT_EQ(second[0].triangle, 1u);
  EXPECT_EQ(laid.layout.corners(second[0])[0], glm::dvec2(16, 16));
  Mesh below;
  add_floor(below, {0.25f, 1.25f}, {0.25f, 1.75f}, {0.75f, 1.75f});
  EXPECT_THAT([&] { (Laid{below, {.udim = true}}); }, ThrowsMessage<std::invalid_argument>(HasSubstr("UDIM")));
}

TEST(TextureCharts, AreJoinedWhereTheTextureGoesOn) {
  Mesh mesh;
  add_uv_quad(mesh, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 0}, {0.5f, 1}});
  add_uv_quad(mesh, {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}}, {{0.5f, 0}, {1, 1}});    // goes on
  add_uv_quad(mesh, {{2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {2, 1, 0}}, {{0, 0}, {0.5f, 1}});    // a seam
  add_uv_quad(mesh, {{3, 0, 0}, {3, 0, -1}, {3, 1, -1}, {3, 1, 0}}, {{0, 0}, {0.5f, 1}});  // a crease
  add_uv_quad(mesh, {{-1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {-1, 1, 0}}, {{0.5f, 0}, {0, 1}});  // folded over the first
  const Laid laid(mesh);
  const TextureCharts charts = find_charts(laid.layout);
  EXPECT_EQ(charts.firsts, (std::vector<std::uint32_t>{0, 0, 0, 0, 4, 4, 6, 6, 8, 8}));
  ASSERT_EQ(charts.seams.size(), 1u);
  EXPECT_EQ(charts.seams[0].sides[0].triangle + charts.seams[0].sides[1].triangle, 2u + 5u);
}

}  // namespace
}  // namespace lkao::bake
