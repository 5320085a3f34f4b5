#include "scene/holes.h"

#include <limits>

#include <gtest/gtest.h>

#include "alpha_files.h"
#include "scene/camera.h"
#include "scene/defects.h"
#include "scene/mesh.h"

namespace lkao::scene {
namespace {

constexpr TextureWrap kWraps[] = {TextureWrap::repeat, TextureWrap::mirror, TextureWrap::clamp};

// The square [0, 1]^2 at z = 0, cut along its diagonal; texture coordinates are x and y.
Mesh square(HoleMaterial material) {
  Mesh mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}, {0, 2, 3}}};
  Holes holes{.materials = {std::move(material)}, .triangles = {}, .numbers = {0, 1}};
  for (const glm::uvec3& t : mesh.triangles) {
    HoleTriangle triangle;
    for (int i = 0; i < 3; ++i) triangle.uvs[static_cast<std::size_t>(i)] = glm::vec2(mesh.positions[t[i]]);
    holes.triangles.push_back(triangle);
  }
  mesh.holes = std::make_shared<const Holes>(std::move(holes));
  return mesh;
}

// Two columns: the left one is clear.
AlphaTexture half_clear() { return {std::make_shared<const AlphaImage>(AlphaImage{2, 1, {0, 65535}}), {}, false}; }

TEST(AlphaTexture, ShowsWhatAPlainSamplerDoes) {
  for (const bool is_smooth : {false, true}) {
    for (const TextureWrap u : kWraps) {
      for (const TextureWrap v : kWraps) {
        const AlphaTexture texture = random_texture(5, 3, {u, v}, is_smooth);
        for (int i = -40; i <= 60; ++i) {
          for (int k = -23; k <= 41; k += 4) {
            const glm::dvec2 uv(i * 0.0713, k * 0.0917);
            ASSERT_NEAR(texture.at(uv), plain_alpha(texture, uv), 1e-12) << uv.x << ", " << uv.y;
          }
        }
      }
    }
  }
}

TEST(AlphaTexture, IsOneWhereItIsNotAskedForAPlace) {
  const AlphaTexture texture = half_clear();
  EXPECT_EQ(texture.at({std::numeric_limits<double>::quiet_NaN(), 0}), 1);
  EXPECT_EQ(texture.at({0, std::numeric_limits<double>::infinity()}), 1);
  EXPECT_EQ(texture.at({0.25, 1e300}), 0);
}

TEST(Holes, AreWhereAlphaIsBelowTheCutOff) {
  const Mesh mesh = square({.cut_off = 0.5, .factor = 1, .texture = half_clear()});
  // In the lower triangle x = u + v, in the upper one x = u.
  EXPECT_FALSE(mesh.holes->blocks(0, {0.4f, 0.05f}));
  EXPECT_TRUE(mesh.holes->blocks(0, {0.4f, 0.15f}));
  EXPECT_FALSE(mesh.holes->blocks(1, {0.4f, 0.5f}));
  EXPECT_TRUE(mesh.holes->blocks(1, {0.6f, 0.3f}));
  // An alpha that is the cut-off is opaque, wherever it is.
  const Mesh even = square({.cut_off = 0.7, .factor = 0.7});
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(even.holes->blocks(0, {0.011f * static_cast<float>(i), 0.3f})) << i;
}

TEST(Holes, MultiplyFactorImageAndCorners) {
  Mesh mesh = square({.cut_off = 0.5, .factor = 0.5, .texture = random_texture(5, 3, {}, true)});
  Holes holes = *mesh.holes;
  holes.triangles[0].alphas = {0.25f, 0.5f, 1};
  const glm::dvec2 place(0.25, 0.5);
  const double image = plain_alpha(*holes.materials[0].texture, {0.75, 0.5});
  EXPECT_NEAR(holes.alpha(0, place), 0.5 * image * (0.25 * 0.25 + 0.25 * 0.5 + 0.5), 1e-12);
  holes.numbers[0] = kWhole;
  EXPECT_EQ(holes.alpha(0, place), 1);
  EXPECT_TRUE(holes.blocks(0, glm::vec2(place)));
}

TEST(Holes, OfTheHalfTransparentAreThereByChance) {
  const Mesh mesh = square({.factor = 0.3});
  int count[2] = {0, 0};
  for (int i = 0; i < 100; ++i) {
    for (int k = 0; k < 100; ++k) {
      const glm::vec2 place(0.005f * static_cast<float>(i), 0.005f * static_cast<float>(k));
      for (std::size_t t = 0; t < 2; ++t) count[t] += mesh.holes->blocks(t, place) ? 1 : 0;
      EXPECT_EQ(mesh.holes->blocks(0, place), mesh.holes->blocks(0, place));
    }
  }
  // Six standard deviations.
  for (const int blocked : count) EXPECT_NEAR(blocked, 3000, 6 * 46);
  EXPECT_NE(count[0], count[1]);
  EXPECT_TRUE(square({.factor = 1}).holes->blocks(0, {0.1f, 0.2f}));
  EXPECT_FALSE(square({.factor = 0}).holes->blocks(0, {0.1f, 0.2f}));
}

TEST(Holes, StayWithTheirTriangles) {
  const Mesh mesh = square({.cut_off = 0.5, .factor = 1, .texture = half_clear()});
  Mesh turned = mesh;
  turn_round(turned);
  EXPECT_FALSE(turned.holes->blocks(0, {0.05f, 0.4f}));
  EXPECT_TRUE(turned.holes->blocks(0, {0.15f, 0.4f}));

  Mesh joined{.positions = {{0, 0, 1}, {1, 0, 1}, {1, 0, 1}, {1, 1, 1}}, .triangles = {{0, 1, 2}, {0, 1, 3}}};
  append(joined, square({.factor = 0}));
  append(joined, mesh);
  append(joined, Mesh{.positions = joined.positions, .triangles = {{0, 1, 3}}});
  ASSERT_EQ(joined.holes->numbers.size(), 7u);
  drop_bad_triangles(joined);
  ASSERT_EQ(joined.holes->numbers.size(), 6u);
  EXPECT_EQ(joined.holes->alpha(0, {0.4, 0.05}), 1);
  EXPECT_EQ(joined.holes->alpha(1, {0.4, 0.15}), 0);
  EXPECT_EQ(joined.holes->alpha(3, {0.4, 0.05}), 0);
  EXPECT_EQ(joined.holes->alpha(3, {0.4, 0.15}), 1);
  EXPECT_EQ(joined.holes->alpha(5, {0.4, 0.05}), 1);
}

TEST(Holes, StayWithTheirObjects) {
  Mesh mesh = square({.cut_off = 0.5, .factor = 1, .texture = half_clear()});
  append(mesh, Mesh(mesh));
  mesh.objects = {1, 0, 1, kNoObject};
  const std::vector<Mesh> objects = split_by_objects(mesh);
  ASSERT_EQ(objects.size(), 2u);
  EXPECT_EQ(objects[0].positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(objects[0].triangles, (std::vector<glm::uvec3>{{0, 1, 2}}));
  EXPECT_EQ(objects[0].holes->alpha(0, {0.4, 0.5}), 0);
  EXPECT_EQ(objects[0].holes->alpha(0, {0.6, 0.3}), 1);
  EXPECT_EQ(objects[1].positions.size(), 6u);
  EXPECT_EQ(objects[1].triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {3, 4, 5}}));
  EXPECT_EQ(objects[1].holes->alpha(1, {0.4, 0.05}), 0);
  mesh.objects = {0, 0, kNoObject, kNoObject};
  append(mesh, Mesh(mesh));
  EXPECT_EQ(mesh.objects,
            (std::vector<std::uint32_t>{0, 0, kNoObject, kNoObject, kNoObject, kNoObject, kNoObject, kNoObject}));
  mesh.positions[1] = mesh.positions[0];
  drop_bad_triangles(mesh);
  EXPECT_EQ(mesh.objects.size(), mesh.triangles.size());
  EXPECT_LT(mesh.objects.size(), 8u);
}

TEST(Holes, AreLookedThroughByCameras) {
  Mesh mesh = square({.cut_off = 0.5, .factor = 1, .texture = half_clear()});
  append(mesh,
         Mesh{.positions = {{0, 0, -1}, {1, 0, -1}, {1, 1, -1}, {0, 1, -1}}, .triangles = {{0, 1, 2}, {0, 2, 3}}});
  const Camera camera{.eye = {0.5f, 0.5f, 2}, .target = {0.5f, 0.5f, 0}, .up = {0, 1, 0}, .fov = 20};
  const ReceiverImage image = find_receivers(mesh, camera, 16, 16);
  for (int row = 0; row < 16; ++row) {
    for (int column = 0; column < 16; ++column) {
      const Receiver& receiver = image.receivers[static_cast<std::size_t>(16 * row + column)];
      EXPECT_EQ(receiver.position.z, column < 8 ? -1 : 0) << column << ", " << row;
    }
  }
  EXPECT_EQ(find_receivers(square({.factor = 0.49}), camera, 4, 4).receiver_count, 0u);
  EXPECT_EQ(find_receivers(square({.factor = 0.5}), camera, 4, 4).receiver_count, 16u);
}

}  // namespace
}  // namespace lkao::scene
