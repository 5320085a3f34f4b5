// Pictures that are parts of larger textures, or every n-th pixel of them; and pictures of several sizes by turns.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "gpu/in_furnished_room.h"

namespace lkao::gl::tests::parts_test {
namespace {

constexpr int kWidth = 65;
constexpr int kHeight = 50;

class Parts : public InFurnishedRoom<kWidth, kHeight> {
 protected:
  static PlaneMaskTable table() { return PlaneMaskTable(SamplePattern::standard(100), {.resolution = 32}); }
};

// A texture with another one in it, from `part` on, and its first texel in all other places.
Texture surround(ObjectName inner, GLenum format, int width, int height, const Part& part) {
  Texture texture = make_texture(GL_TEXTURE_2D);
  const int outer_width = width + 2 * part.x + 3, outer_height = height + 2 * part.y + 5;
  glTextureStorage2D(texture.name(), 1, format, outer_width, outer_height);
  for (int y = 0; y < outer_height; ++y) {
    for (int x = 0; x < outer_width; ++x) {
      glCopyImageSubData(inner, GL_TEXTURE_2D, 0, 0, 0, 0, texture.name(), GL_TEXTURE_2D, 0, x, y, 0, 1, 1, 1);
    }
  }
  glCopyImageSubData(inner, GL_TEXTURE_2D, 0, 0, 0, 0, texture.name(), GL_TEXTURE_2D, 0, part.x, part.y, 0, width,
                     height, 1);
  return texture;
}

TEST_F(Parts, OfLargerTexturesAnswerAsTexturesOfTheirOwn) {
  PassOnMesh pass = make_pass(mesh_, table());
  const RayOptions options{.radius = 1.0f, .jitter = {.rotation = 1}};
  for (const Part& part : {Part{}, Part{.x = 17, .y = 6}}) {
    const Texture normals = surround(g_buffer_->normals(), GL_RGBA32F, kWidth, kHeight, part);
    for (const GBuffer& alone : {g_buffer_->by_positions(), g_buffer_->by_linear_depth(), g_buffer_->by_depth()}) {
      pass.draw(alone, camera_, options);
      const std::vector<std::uint64_t> expected = pass.read_masks();
      GBuffer within = alone;
      within.part = part;
      within.normals = normals.name();
      const GLenum format = alone.positions != 0      ? GL_RGBA32F
                            : alone.linear_depth != 0 ? GL_R32F
                                                      : GL_DEPTH_COMPONENT32F;
      const Texture place = surround(alone.positions + alone.linear_depth + alone.depth, format, kWidth, kHeight, part);
      if (alone.positions != 0) within.positions = place.name();
      if (alone.linear_depth != 0) within.linear_depth = place.name();
      if (alone.depth != 0) within.depth = place.name();
      pass.draw(within, camera_, options);
      EXPECT_EQ(pass.read_masks(), expected) << part.x;
    }
  }
}

TEST_F(Parts, OfATargetAreAllThatIsWritten) {
  PassOnMesh pass = make_pass(mesh_, table());
  pass.draw(g_buffer_->by_positions(), camera_, {.radius = 1.0f});
  const Texture alone = make_image(GL_R32F, kWidth, kHeight), alone_bent = make_image(GL_RGBA32F, kWidth, kHeight);
  pass.resolve({.occlusion = {alone.name(), 0.25f}, .bent_normals = alone_bent.name()});
  const std::vector<glm::vec4> occlusion = read_image(alone.name(), kWidth, kHeight);
  const std::vector<glm::vec4> bent_normals = read_image(alone_bent.name(), kWidth, kHeight);

  constexpr int kOuterWidth = kWidth + 20, kOuterHeight = kHeight + 9;
  const Part part{.x = 13, .y = 9};
  const std::vector<glm::vec4> before(std::size_t{kOuterWidth} * kOuterHeight, glm::vec4(7));
  const Texture wide = make_image(GL_R32F, kOuterWidth, kOuterHeight, &before[0].x);
  const Texture wide_bent = make_image(GL_RGBA32F, kOuterWidth, kOuterHeight, &before[0].x);
  pass.resolve(
      {.occlusion = {.texture = wide.name(), .background = 0.25f, .part = part}, .bent_normals = wide_bent.name()});
  const std::vector<glm::vec4> found = read_image(wide.name(), kOuterWidth, kOuterHeight);
  const std::vector<glm::vec4> found_bent = read_image(wide_bent.name(), kOuterWidth, kOuterHeight);
  for (int y = 0; y < kOuterHeight; ++y) {
    for (int x = 0; x < kOuterWidth; ++x) {
      const auto at = static_cast<std::size_t>(y * kOuterWidth + x);
      const int inner_x = x - part.x, inner_y = y - part.y;
      if (inner_x < 0 || inner_y < 0 || inner_x >= kWidth || inner_y >= kHeight) {
        ASSERT_EQ(found[at].x, 7.0f) << x << ' ' << y;
        ASSERT_EQ(found_bent[at], glm::vec4(7)) << x << ' ' << y;
      } else {
        const auto inner = static_cast<std::size_t>(inner_y * kWidth + inner_x);
        ASSERT_EQ(found[at].x, occlusion[inner].x) << x << ' ' << y;
        ASSERT_EQ(found_bent[at], bent_normals[inner]) << x << ' ' << y;
      }
    }
  }
}

TEST_F(Parts, ThatLieOutsideAreRefused) {
  PassOnMesh pass = make_pass(mesh_, table());
  const auto expect = [](const std::string& line, const std::function<void()>& mistake) {
    try {
      mistake();
      ADD_FAILURE() << "no exception: " << line;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(), line);
    }
  };
  GBuffer textures = g_buffer_->by_depth();
  textures.part = Part{.x = 1};
  expect("depth of 65x50 pixels has no part of 65x50 at (1, 0)", [&] { pass.draw(textures, camera_, {.radius = 1}); });
  textures.part = Part{.y = -1};
  expect("depth of 65x50 pixels has no part of 65x50 at (0, -1)", [&] { pass.draw(textures, camera_, {.radius = 1}); });
  textures.part.reset();
  for (const int step : {0, -3, 17}) {
    textures.step = step;
    expect("step must be from 1 to 16, not " + std::to_string(step),
           [&] { pass.draw(textures, camera_, {.radius = 1}); });
  }
  textures.step = 2;
  pass.draw(textures, camera_, {.radius = 1});
  const Texture whole = make_image(GL_R8, kWidth, kHeight);
  expect("occlusion must be of 33x25 pixels, not 65x50", [&] { pass.resolve({.occlusion = {whole.name()}}); });
  expect("occlusion of 65x50 pixels has no part of 33x25 at (2147483647, 0)",
         [&] { pass.resolve({.occlusion = {.texture = whole.name(), .part = Part{.x = 2147483647}}}); });
  EXPECT_NO_THROW(pass.resolve({.occlusion = {.texture = whole.name(), .part = Part{.x = 32, .y = 25}}}));
}

struct Shot {
  std::string name;
  GBuffer textures;
  Camera camera;
};

TEST_F(Parts, EveryNthPixelIsThatPixel) {
  PassOnMesh pass = make_pass(mesh_, table());
  // Pixels are turned by their numbers, which differ.
  const RayOptions options{.radius = 1.0f, .jitter = {.rotation = 0}};
  Camera orthographic = camera_;
  orthographic.projection = glm::ortho(-2.0f, 1.0f, -1.5f, 1.7f, 0.1f, 20.0f);
  const GBufferPass flat(mesh_, orthographic, kWidth, kHeight);
  for (const Shot& shot :
       {Shot{"positions", g_buffer_->by_positions(), camera_},
        Shot{"view-space positions", g_buffer_->by_view_positions(), camera_},
        Shot{"depth", g_buffer_->by_depth(), camera_}, Shot{"linear depth", g_buffer_->by_linear_depth(), camera_},
        Shot{"orthographic depth", flat.by_depth(), orthographic}}) {
    pass.draw(shot.textures, shot.camera, options);
    const std::vector<PixelReceiver> all = pass.read_receivers();
    const std::vector<std::uint64_t> all_masks = pass.read_masks();
    for (const int step : {2, 3, 16}) {
      GBuffer textures = shot.textures;
      textures.step = step;
      pass.draw(textures, shot.camera, options);
      const std::vector<PixelReceiver> some = pass.read_receivers();
      const std::vector<std::uint64_t> masks = pass.read_masks();
      const int width = textures.picture_width(), height = textures.picture_height();
      ASSERT_EQ(some.size(), static_cast<std::size_t>(width * height));
      std::size_t other_count = 0;
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          const auto at = static_cast<std::size_t>(y * width + x);
          const auto of_all = static_cast<std::size_t>(y * step * kWidth + x * step);
          ASSERT_EQ(some[at].is_valid, all[of_all].is_valid);
          ASSERT_LE(glm::distance(some[at].origin, all[of_all].origin), 2e-6f) << shot.name << ' ' << x << ' ' << y;
          ASSERT_EQ(some[at].frame, all[of_all].frame);
          other_count += masks[2 * at] != all_masks[2 * of_all] || masks[2 * at + 1] != all_masks[2 * of_all + 1];
        }
      }
      // Depths are unprojected through another matrix: another last bit.
      EXPECT_LE(other_count, shot.textures.positions != 0 ? 0 : some.size() / 100) << shot.name << ", step " << step;
    }
  }
}

TEST_F(Parts, SizesByTurnsMakeNothingNew) {
  struct Picture {
    Camera camera;
    GBufferPass g_buffer;
    std::vector<std::uint64_t> expected;
  };
  for (const Accumulator accumulator : {Accumulator::logic_op, Accumulator::ssbo}) {
    std::vector<Picture> pictures;
    for (const auto& [width, height] : {std::pair{48, 24}, {20, 32}, {48, 32}, {1, 1}}) {
      const Camera camera = room_camera(width, height);
      pictures.push_back({camera, GBufferPass(mesh_, camera, width, height), {}});
      PassOnMesh fresh = make_pass(mesh_, table(), {.accumulator = accumulator});
      fresh.draw(pictures.back().g_buffer.by_positions(), camera, {.radius = 1.0f});
      pictures.back().expected = fresh.read_masks();
    }
    PassOnMesh pass = make_pass(mesh_, table(), {.accumulator = accumulator});
    std::vector<ObjectName> textures;
    for (int round = 0; round < 2; ++round) {
      for (const Picture& picture : pictures) {
        pass.draw(picture.g_buffer.by_positions(), picture.camera, {.radius = 1.0f});
        EXPECT_EQ(pass.read_masks(), picture.expected);
        textures.push_back(pass.masks_texture());
      }
    }
    // The first two sizes make it as large as it will be.
    EXPECT_EQ(std::count(textures.begin() + 1, textures.end(), textures[1]), 7);
    GLint width = 0, height = 0;
    glGetTextureLevelParameteriv(textures.back(), 0, GL_TEXTURE_WIDTH, &width);
    glGetTextureLevelParameteriv(textures.back(), 0, GL_TEXTURE_HEIGHT, &height);
    EXPECT_EQ(std::pair(width, height), std::pair(48, 32));
  }
}

TEST_F(Parts, OneHighAndOneWidePictureAreNotOneLargeOne) {
  Mesh little = mesh_;
  little.triangles.resize(12);
  PassOnMesh pass = make_pass(little, table());
  for (const auto& [width, height] : {std::pair{2048, 2}, {2, 2048}, {2048, 2}}) {
    const Camera camera = room_camera(width, height);
    const GBufferPass g_buffer(little, camera, width, height);
    pass.draw(g_buffer.by_positions(), camera, {.radius = 0.1f});
    GLint height_of_masks = 0;
    glGetTextureLevelParameteriv(pass.masks_texture(), 0, GL_TEXTURE_HEIGHT, &height_of_masks);
    EXPECT_EQ(height_of_masks, height);
  }
}

}  // namespace
}  // namespace lkao::gl::tests::parts_test
