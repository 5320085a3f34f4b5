#include "scene/hole_survey.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <glm/common.hpp>

#include "alpha_files.h"
#include "scene/shapes.h"
#include "scene/texel_bounds.h"

namespace lkao::scene {
namespace {

constexpr TextureWrap kAllWraps[] = {TextureWrap::repeat, TextureWrap::mirror, TextureWrap::clamp};

// A blot and clear around it.
std::shared_ptr<const AlphaImage> blot(int width, int height) {
  AlphaImage image{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool is_inside = 2 * x >= width / 2 && 2 * x < width && 3 * y < 2 * height;
      image.alphas.push_back(static_cast<std::uint16_t>(is_inside ? 65535 : 0));
    }
  }
  return std::make_shared<const AlphaImage>(std::move(image));
}

TEST(TexelBounds, HoldWhatPlacesShow) {
  Random random(1);
  for (const auto& [u, v] : {std::pair{0, 1}, {1, 2}, {2, 0}}) {
    for (const bool is_smooth : {false, true}) {
      AlphaTexture texture = random_texture(37, 21, {kAllWraps[u], kAllWraps[v]}, is_smooth);
      const TexelBounds bounds(texture.image);
      for (int i = 0; i < 200; ++i) {
        const glm::dvec2 lower(random.uniform(-3, 3), random.uniform(-3, 3));
        const glm::dvec2 size(random.uniform(0, i % 2 == 0 ? 0.05 : 2), random.uniform(0, i % 3 == 0 ? 0.05 : 2));
        const AlphaRange range = bounds.of(texture, lower, lower + size);
        for (int k = 0; k < 20; ++k) {
          const glm::dvec2 place = lower + size * glm::dvec2(k % 2 == 0 ? random.uniform() : 1, random.uniform());
          ASSERT_GE(texture.at(place), range.least) << place.x << ", " << place.y;
          ASSERT_LE(texture.at(place), range.most) << place.x << ", " << place.y;
        }
      }
    }
  }
}

// Of few texels exactly, of an image's blocks no more than they hold.
TEST(TexelBounds, AreTightWhereTheImageIs) {
  const AlphaTexture texture{blot(64, 64), {}, false};
  const TexelBounds bounds(texture.image);
  const AlphaRange within = bounds.of(texture, {0.26, 0.01}, {0.49, 0.6}),
                   beside = bounds.of(texture, {0.6, 0}, {0.9, 1});
  EXPECT_EQ(within.least, 1);
  EXPECT_EQ(beside.most, 0);
  const AlphaRange all = bounds.of(texture, {-5, 0.1}, {5, 0.2}), far = bounds.of(texture, {1e12, 0}, {1e12, 0});
  EXPECT_EQ(all.least, 0);
  EXPECT_EQ(all.most, 1);
  EXPECT_EQ(far.least, 0);
  EXPECT_EQ(far.most, 1);
}

// A triangle of each kind of material, somewhere on its image.
Holes all_kinds(Random& random) {
  Holes holes;
  for (int i = 0; i < 24; ++i) {
    HoleMaterial material;
    if (i % 3 != 0) material.cut_off = i % 3 == 1 ? 0.5 : 0.9;
    if (i % 4 == 1) material.factor = 0.7;
    const TextureWraps wraps{kAllWraps[i % 3], kAllWraps[i / 3 % 3]};
    if (i % 8 != 7) material.texture = AlphaTexture{blot(32, 24), wraps, i % 2 == 0};
    HoleTriangle triangle{.material = static_cast<std::uint32_t>(i)};
    const glm::vec2 middle(random.uniform(-2, 2), random.uniform(-2, 2));
    for (glm::vec2& uv : triangle.uvs) {
      uv = middle + glm::vec2(random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6));
    }
    if (i % 8 >= 6) triangle.alphas = {1, 0.2f, 0.8f};
    holes.materials.push_back(std::move(material));
    holes.triangles.push_back(triangle);
    holes.numbers.push_back(static_cast<std::uint32_t>(i));
  }
  return holes;
}

TEST(HoleSurvey, NeverSaysOtherwiseThanTheHoles) {
  Random random(2);
  const auto holes = std::make_shared<const Holes>(all_kinds(random));
  const HoleSurvey survey(holes);
  int count_of[3] = {0, 0, 0};
  for (std::uint32_t triangle = 0; triangle < holes->triangles.size(); ++triangle) {
    for (int i = 0; i < 300; ++i) {
      const int level = 1 + random.below(5), size = 1 << level;
      const float width = 1.0f / static_cast<float>(size);
      const float u0 = width * static_cast<float>(random.below(size)),
                  v0 = width * static_cast<float>(random.below(size));
      const CutOutPart part = survey(triangle, u0, v0, width);
      ++count_of[static_cast<int>(part)];
      for (int k = 0; part != CutOutPart::mixed && k < 10; ++k) {
        const glm::vec2 place = glm::vec2(u0, v0) + width * glm::vec2(random.uniform(), k == 0 ? 1 : random.uniform());
        ASSERT_EQ(holes->blocks(triangle, place), part == CutOutPart::opaque) << triangle << ": " << u0 << ", " << v0;
      }
    }
  }
  for (const int count : count_of) EXPECT_GT(count, 200);
}

TEST(HoleSurvey, KnowsNothingOfNumbersThatAreNone) {
  Holes holes{
      .materials = {{.cut_off = 0.5}}, .triangles = {{.alphas = {1, std::nanf(""), 1}}}, .numbers = {0, kWhole}};
  const HoleSurvey survey(std::make_shared<const Holes>(holes));
  EXPECT_EQ(survey(0, 0, 0, 1), CutOutPart::mixed);
  EXPECT_EQ(survey(1, 0, 0, 1), CutOutPart::opaque);
}

TEST(HoleSurvey, TrianglesLookAlikeWhereAllOfTheirHolesIs) {
  const HoleTriangle one{.material = 0, .uvs = {glm::vec2(0, 0), {1, 0}, {0, 1}}};
  HoleTriangle other = one;
  other.uvs[2].y = 0.5f;
  const Holes holes{.materials = {{}}, .triangles = {one, other, one}, .numbers = {0, kWhole, 1, 2}};
  const std::vector<std::uint32_t> looks = looks_of(holes);
  ASSERT_EQ(looks.size(), 4u);
  EXPECT_EQ(looks[0], looks[3]);
  EXPECT_NE(looks[0], looks[2]);
}

}  // namespace
}  // namespace lkao::scene
