// The cross-bilateral filter smooths within surfaces and not across their edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "gpu/g_buffer_pass.h"
#include "gpu/in_furnished_room.h"
#include "gpu/view_surfaces.h"
#include "lkao/gl/bilateral_filter.h"
#include "lut/random.h"

namespace lkao::gl::tests::bilateral_filter_test {
namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 48;
constexpr std::size_t kPixelCount = std::size_t{kWidth} * kHeight;

// The definition once more: one direction, in double precision.
std::vector<double> filter_once(const ViewSurfaces& surfaces, const std::vector<double>& values, int step_x, int step_y,
                                double background, const BilateralFilterOptions& options) {
  const auto index = [](int x, int y) { return static_cast<std::size_t>(y * kWidth + x); };
  std::vector<double> result(values.size(), background);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const std::size_t middle = index(x, y);
      if (!surfaces.has_receiver(middle)) continue;
      double sum = values[middle], weights = 1;
      for (int i = -options.radius; i <= options.radius; ++i) {
        const int to_x = x + i * step_x, to_y = y + i * step_y;
        if (i == 0 || to_x < 0 || to_y < 0 || to_x >= kWidth || to_y >= kHeight) continue;
        const std::size_t other = index(to_x, to_y);
        if (!surfaces.has_receiver(other)) continue;
        const double weight = gauss_weight(i * i, options) * surfaces.likeness(middle, other, options);
        sum += weight * values[other];
        weights += weight;
      }
      result[middle] = sum / weights;
    }
  }
  return result;
}

class BilateralFilterOnRoom : public InFurnishedRoom<kWidth, kHeight> {
 protected:
  void SetUp() override {
    InFurnishedRoom::SetUp();
    if (IsSkipped()) return;
    lut::RandomStream random(5);
    for (std::size_t i = 0; i < kPixelCount; ++i) noise_.push_back(static_cast<float>(random.next_double()));
    filter_ = std::make_unique<BilateralFilter>();
  }
  void TearDown() override {
    filter_.reset();
    InFurnishedRoom::TearDown();
  }

  static Texture upload(const std::vector<float>& values) {
    Texture texture = make_image(GL_R32F, kWidth, kHeight);
    glTextureSubImage2D(texture.name(), 0, 0, 0, kWidth, kHeight, GL_RED, GL_FLOAT, values.data());
    return texture;
  }

  std::vector<float> filter(const GBuffer& g_buffer, const Camera& camera, const std::vector<float>& values,
                            const BilateralFilterOptions& options, float background = 0.5f) {
    const Texture from = upload(values), to = make_image(GL_R32F, kWidth, kHeight);
    filter_->filter(g_buffer, camera, {from.name()}, {to.name(), background}, options);
    std::vector<float> result;
    for (const glm::vec4& texel : read_image(to.name(), kWidth, kHeight)) result.push_back(texel.x);
    return result;
  }

  // What the filter is to give, from the receivers of a G-buffer.
  std::vector<double> expected(const GBufferPass& g_buffer, const Camera& camera,
                               const BilateralFilterOptions& options) const {
    const ViewSurfaces surfaces(g_buffer.receivers(), camera, kWidth, kHeight);
    const std::vector<double> values(noise_.begin(), noise_.end());
    return filter_once(surfaces, filter_once(surfaces, values, 1, 0, 0.5, options), 0, 1, 0.5, options);
  }

  std::unique_ptr<BilateralFilter> filter_;
  std::vector<float> noise_;
};

TEST_F(BilateralFilterOnRoom, IsTheSumThatItsDefinitionSays) {
  const BilateralFilterOptions all_options[] = {
      {}, {.radius = 1}, {.radius = 7, .depth_tolerance = 0.5f}, {.radius = 3, .normal_sharpness = 0}};
  Camera orthographic = camera_;
  orthographic.projection = glm::ortho(-2.0f, 2.0f, -1.5f, 1.5f, 0.1f, 20.0f);
  for (const Camera& camera : {camera_, orthographic}) {
    const GBufferPass g_buffer(mesh_, camera, kWidth, kHeight);
    for (const BilateralFilterOptions& options : all_options) {
      const std::vector<double> wanted = expected(g_buffer, camera, options);
      for (const GBuffer& textures : {g_buffer.by_positions(), g_buffer.by_depth(), g_buffer.by_linear_depth()}) {
        const std::vector<float> result = filter(textures, camera, noise_, options);
        double largest_error = 0;
        for (std::size_t i = 0; i < kPixelCount; ++i) {
          largest_error = std::max(largest_error, std::fabs(result[i] - wanted[i]));
        }
        // Positions found from depths of 32 bits are off by some 1e-6 of the distance.
        EXPECT_LT(largest_error, 2e-3) << "radius " << options.radius;
      }
    }
  }
}

TEST_F(BilateralFilterOnRoom, SmoothsNoiseAndKeepsWhatIsConstant) {
  const GBuffer textures = g_buffer_->by_depth();
  const auto spread = [](const std::vector<float>& values) {
    double sum = 0, squares = 0;
    for (const float value : values) sum += value, squares += double{value} * value;
    const auto count = static_cast<double>(values.size());
    return squares / count - sum / count * sum / count;
  };
  EXPECT_LT(4 * spread(filter(textures, camera_, noise_, {})), spread(noise_));
  const std::vector<float> constant(kPixelCount, 0.375f);
  for (const float value : filter(textures, camera_, constant, {})) EXPECT_NEAR(value, 0.375f, 1e-6f);
}

TEST_F(BilateralFilterOnRoom, LeavesEdgesOfDepthAndOfNormalsSharp) {
  // Left and right are planes that face the camera at different depths; or one folded plane.
  const Camera camera{glm::mat4(1), glm::perspective(1.0f, float{kWidth} / kHeight, 0.1f, 100.0f)};
  struct Edge {
    float left_z, right_z;
    glm::vec3 right_normal;
  };
  for (const Edge& edge : {Edge{-3, -5, {0, 0, 1}}, Edge{-3, -3, {1, 0, 0}}}) {
    std::vector<glm::vec4> positions, normals;
    std::vector<float> values;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const bool is_left = x < kWidth / 2;
        const float z = is_left ? edge.left_z : edge.right_z;
        positions.emplace_back(z * 0.01f * static_cast<float>(kWidth / 2 - x), z * 0.01f * static_cast<float>(y), z, 1);
        normals.push_back(is_left ? glm::vec4(0, 0, 2, 0) : 2.0f * glm::vec4(edge.right_normal, 0));
        values.push_back(is_left ? 0.0f : 1.0f);
      }
    }
    const Texture place = make_image(GL_RGBA32F, kWidth, kHeight, &positions[0].x);
    const Texture normal = make_image(GL_RGBA32F, kWidth, kHeight, &normals[0].x);
    const GBuffer textures{.width = kWidth, .height = kHeight, .positions = place.name(), .normals = normal.name()};
    const std::vector<float> result = filter(textures, camera, values, {});
    for (std::size_t i = 0; i < kPixelCount; ++i) EXPECT_NEAR(result[i], values[i], 1e-5f);
  }
}

TEST_F(BilateralFilterOnRoom, PassesPixelsWithoutReceiversBy) {
  Camera away = camera_;
  away.view = glm::lookAt(glm::vec3(0.3f, 1.9f, 12), glm::vec3(0, 1.3f, 0), glm::vec3(0, 1, 0));
  const GBufferPass sky(mesh_, away, kWidth, kHeight);
  const std::vector<Receiver> receivers = sky.receivers();
  std::vector<float> values(kPixelCount, 0.25f);
  std::size_t empty_count = 0;
  for (std::size_t i = 0; i < kPixelCount; ++i) {
    if (receivers[i].normal != glm::vec3(0)) continue;
    values[i] = std::numeric_limits<float>::quiet_NaN();
    ++empty_count;
  }
  ASSERT_GT(empty_count, kPixelCount / 10);
  ASSERT_LT(empty_count, kPixelCount);
  const std::vector<float> result = filter(sky.by_depth(), away, values, {.radius = 16}, 0.75f);
  for (std::size_t i = 0; i < kPixelCount; ++i) {
    EXPECT_NEAR(result[i], receivers[i].normal == glm::vec3(0) ? 0.75f : 0.25f, 1e-6f);
  }
}

TEST_F(BilateralFilterOnRoom, MayWriteWhereItReads) {
  const Texture texture = upload(noise_);
  filter_->filter(g_buffer_->by_depth(), camera_, {texture.name()}, {texture.name(), 0.5f});
  const std::vector<float> elsewhere = filter(g_buffer_->by_depth(), camera_, noise_, {});
  const std::vector<glm::vec4> texels = read_image(texture.name(), kWidth, kHeight);
  for (std::size_t i = 0; i < kPixelCount; ++i) EXPECT_EQ(texels[i].x, elsewhere[i]);
}

TEST_F(BilateralFilterOnRoom, NamesWhatIsWrong) {
  const Texture occlusion = upload(noise_), small = make_image(GL_R32F, kWidth, kHeight - 1);
  const Texture integers = make_image(GL_R32UI, kWidth, kHeight), color = make_image(GL_SRGB8_ALPHA8, kWidth, kHeight);
  const auto expect = [&](const std::string& named, ObjectName from, ObjectName to,
                          const BilateralFilterOptions& options) {
    try {
      filter_->filter(g_buffer_->by_depth(), camera_, {from}, {to}, options);
      ADD_FAILURE() << "no exception about " << named;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(named), std::string::npos) << error.what();
    }
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  expect("radius", occlusion.name(), occlusion.name(), {.radius = 0});
  expect("radius", occlusion.name(), occlusion.name(), {.radius = 17});
  expect("depth_tolerance", occlusion.name(), occlusion.name(), {.depth_tolerance = 0});
  expect("depth_tolerance", occlusion.name(), occlusion.name(), {.depth_tolerance = nan});
  expect("normal_sharpness", occlusion.name(), occlusion.name(), {.normal_sharpness = -1});
  expect("occlusion must be of", small.name(), occlusion.name(), {});
  expect("occlusion must have 1 float", integers.name(), occlusion.name(), {});
  expect("occlusion cannot be written to the format GL_SRGB8_ALPHA8", occlusion.name(), color.name(), {});
  expect("occlusion is not set", 0, occlusion.name(), {});
}

}  // namespace
}  // namespace lkao::gl::tests::bilateral_filter_test
