// From occlusion of every n-th pixel to that of all of them, within surfaces and not across their edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/in_furnished_room.h"
#include "gpu/view_surfaces.h"
#include "lkao/gl/bilateral_filter.h"
#include "lut/random.h"

namespace lkao::gl::tests::upsample_test {
namespace {

constexpr int kWidth = 63;
constexpr int kHeight = 50;
constexpr std::size_t kPixelCount = std::size_t{kWidth} * kHeight;

std::size_t index(int x, int y) { return static_cast<std::size_t>(y * kWidth + x); }

class Upsample : public InFurnishedRoom<kWidth, kHeight> {
 protected:
  void SetUp() override {
    InFurnishedRoom::SetUp();
    if (!IsSkipped()) filter_ = std::make_unique<BilateralFilter>();
  }
  void TearDown() override {
    filter_.reset();
    InFurnishedRoom::TearDown();
  }

  std::vector<float> upsample(const GBuffer& textures, const Camera& camera, const std::vector<float>& samples,
                              const BilateralFilterOptions& options = {}) {
    const Texture from = make_image(GL_R32F, textures.picture_width(), textures.picture_height());
    const Texture to = make_image(GL_R32F, textures.width, textures.height);
    glTextureSubImage2D(from.name(), 0, 0, 0, textures.picture_width(), textures.picture_height(), GL_RED, GL_FLOAT,
                        samples.data());
    filter_->upsample(textures, camera, {from.name()}, {to.name(), 0.5f}, options);
    std::vector<float> result;
    for (const glm::vec4& texel : read_image(to.name(), textures.width, textures.height)) result.push_back(texel.x);
    return result;
  }

  std::unique_ptr<BilateralFilter> filter_;
};

std::vector<float> noise(std::size_t size) {
  lut::RandomStream random(7);
  std::vector<float> values(size);
  for (float& value : values) value = static_cast<float>(random.next_double());
  return values;
}

// The definition once more, in double precision.
std::vector<double> expected_pixels(const ViewSurfaces& surfaces, const std::vector<float>& samples, int step,
                                    const BilateralFilterOptions& options) {
  const int sample_width = (kWidth - 1) / step + 1, sample_height = (kHeight - 1) / step + 1;
  std::vector<double> result(kPixelCount, 0.5);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (!surfaces.has_receiver(index(x, y))) continue;
      double sum = 0, weights = 0;
      for (int j = 0; j < sample_height; ++j) {
        for (int i = 0; i < sample_width; ++i) {
          const int away_x = i * step - x, away_y = j * step - y;
          const std::size_t other = index(i * step, j * step);
          if (std::max(std::abs(away_x), std::abs(away_y)) > options.radius || !surfaces.has_receiver(other)) continue;
          const double weight = gauss_weight(away_x * away_x + away_y * away_y, options) *
                                (surfaces.likeness(index(x, y), other, options) + 1e-6);
          sum += weight * static_cast<double>(samples[static_cast<std::size_t>(j * sample_width + i)]);
          weights += weight;
        }
      }
      result[index(x, y)] = weights > 0 ? sum / weights : 0;
    }
  }
  return result;
}

TEST_F(Upsample, IsTheSumThatItsDefinitionSays) {
  Camera away = camera_;
  away.view = glm::lookAt(glm::vec3(0.3f, 1.9f, 12), glm::vec3(0, 1.3f, 0), glm::vec3(0, 1, 0));
  for (const Camera& camera : {camera_, away}) {
    const GBufferPass g_buffer(mesh_, camera, kWidth, kHeight);
    const ViewSurfaces surfaces(g_buffer.receivers(), camera, kWidth, kHeight);
    for (const int step : {2, 3, 4}) {
      for (const BilateralFilterOptions& options :
           {BilateralFilterOptions{}, {.radius = 7, .depth_tolerance = 1}, {.radius = 5, .normal_sharpness = 0}}) {
        for (GBuffer textures : {g_buffer.by_positions(), g_buffer.by_linear_depth()}) {
          textures.step = step;
          const std::vector<float> samples =
              noise(static_cast<std::size_t>(textures.picture_width() * textures.picture_height()));
          const std::vector<double> expected = expected_pixels(surfaces, samples, step, options);
          const std::vector<float> found = upsample(textures, camera, samples, options);
          for (std::size_t i = 0; i < kPixelCount; ++i) ASSERT_NEAR(found[i], expected[i], 2e-3) << i;
        }
      }
    }
  }
}

// Half resolution against all pixels: better than to repeat each sample, or to mix them whatever they see.
TEST_F(Upsample, LosesLittleOfTheRoom) {
  constexpr int kWide = 192, kHigh = 144;
  const Camera camera = room_camera(kWide, kHigh);
  const GBufferPass g_buffer(mesh_, camera, kWide, kHigh);
  PassOnMesh pass = make_pass(mesh_, PlaneMaskTable(SamplePattern::standard(64), {.resolution = 32}));
  const auto occlusion_of = [&](const GBuffer& textures) {
    pass.draw_off_surface(textures, camera, {.radius = 0.7f, .jitter = {.rotation = 0}});
    const int width = textures.picture_width(), height = textures.picture_height();
    const Texture image = make_image(GL_R32F, width, height);
    pass.resolve({.occlusion = {image.name()}});
    std::vector<float> values;
    for (const glm::vec4& texel : read_image(image.name(), width, height)) values.push_back(texel.x);
    return values;
  };
  const std::vector<float> whole = occlusion_of(g_buffer.by_depth());
  const auto error_of = [&](const std::vector<float>& found) {
    double sum = 0;
    for (std::size_t i = 0; i < whole.size(); ++i) sum += std::fabs(static_cast<double>(found[i]) - whole[i]);
    return sum / static_cast<double>(whole.size());
  };
  GBuffer half = g_buffer.by_depth();
  half.step = 2;
  const std::vector<float> samples = occlusion_of(half);
  std::vector<float> repeated;
  for (int y = 0; y < kHigh; ++y) {
    for (int x = 0; x < kWide; ++x) repeated.push_back(samples[static_cast<std::size_t>(y / 2 * (kWide / 2) + x / 2)]);
  }
  const double error = error_of(upsample(half, camera, samples, {.radius = 2}));
  const double blind =
      error_of(upsample(half, camera, samples, {.radius = 2, .depth_tolerance = 1e6f, .normal_sharpness = 0}));
  RecordProperty("mean_error_of_half_resolution", std::to_string(error));
  RecordProperty("mean_error_without_edges", std::to_string(blind));
  RecordProperty("mean_error_of_repeated_samples", std::to_string(error_of(repeated)));
  EXPECT_LT(error, 0.010);
  EXPECT_LT(error, 0.7 * blind);
  EXPECT_LT(error, 0.7 * error_of(repeated));
}

// Two walls that face the camera, far behind each other, and a wire of one pixel in a third place.
TEST_F(Upsample, KeepsEdgesAndGivesAWireWhatIsNear) {
  const Camera camera{glm::mat4(1), glm::perspective(1.0f, float{kWidth} / kHeight, 0.1f, 100.0f)};
  std::vector<glm::vec4> distances, normals(kPixelCount, glm::vec4(0, 0, 1, 0));
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) distances.emplace_back(x == 11 ? 1.0f : x < 32 ? 3.0f : 5.0f);
  }
  // One pixel in the sky, far from all samples.
  for (int y = 20; y < kHeight; ++y) {
    for (int x = 40; x < kWidth; ++x) {
      if (x != 51 || y != 35) normals[index(x, y)] = glm::vec4(0);
    }
  }
  const Texture place = make_image(GL_R32F, kWidth, kHeight, &distances[0].x);
  const Texture normal = make_image(GL_RGBA32F, kWidth, kHeight, &normals[0].x);
  const GBuffer textures{
      .width = kWidth, .height = kHeight, .linear_depth = place.name(), .normals = normal.name(), .step = 2};
  std::vector<float> samples;
  for (int y = 0; y < textures.picture_height(); ++y) {
    for (int x = 0; x < textures.picture_width(); ++x) samples.push_back(x < 16 ? 0.25f : 1.0f);
  }
  const std::vector<float> found = upsample(textures, camera, samples);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const bool is_sky = normals[index(x, y)] == glm::vec4(0), is_alone = x == 51 && y == 35;
      const float expected = is_alone ? 0.0f : is_sky ? 0.5f : x < 32 ? 0.25f : 1.0f;
      ASSERT_NEAR(found[index(x, y)], expected, 1e-4f) << x << ' ' << y;
    }
  }
}

TEST_F(Upsample, TakesOtherTargetsAndParts) {
  GBuffer textures = g_buffer_->by_depth();
  textures.step = 2;
  const int width = textures.picture_width(), height = textures.picture_height();
  const std::vector<float> samples = noise(static_cast<std::size_t>(width * height));
  const std::vector<float> expected = upsample(textures, camera_, samples);
  // In one atlas: half a picture of visibility in green, and the whole one beside it in red.
  const int atlas_width = kWidth + width;
  std::vector<glm::vec4> atlas(static_cast<std::size_t>(atlas_width * kHeight), glm::vec4(0.125f));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      atlas[static_cast<std::size_t>(y * atlas_width + kWidth + x)].y =
          1 - samples[static_cast<std::size_t>(y * width + x)];
    }
  }
  const Texture image = make_image(GL_RGBA32F, atlas_width, kHeight, &atlas[0].x);
  const OcclusionTarget from{
      .texture = image.name(), .quantity = Quantity::visibility, .channel = Channel::green, .part = Part{.x = kWidth}};
  filter_->upsample(textures, camera_, from, {.texture = image.name(), .background = 0.5f, .part = Part{}});
  const std::vector<glm::vec4> found = read_image(image.name(), atlas_width, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < atlas_width; ++x) {
      const auto at = static_cast<std::size_t>(y * atlas_width + x);
      ASSERT_NEAR(found[at].x, x < kWidth ? expected[index(x, y)] : atlas[at].x, 1e-6f) << x << ' ' << y;
      ASSERT_EQ(found[at].y, atlas[at].y);
    }
  }
}

TEST_F(Upsample, NamesWhatIsWrong) {
  GBuffer textures = g_buffer_->by_depth();
  textures.step = 6;
  const Texture small = make_image(GL_R32F, textures.picture_width(), textures.picture_height());
  const Texture large = make_image(GL_R32F, kWidth, kHeight);
  const auto expect = [&](const std::string& line, ObjectName from, ObjectName to,
                          const BilateralFilterOptions& options) {
    try {
      filter_->upsample(textures, camera_, {from}, {to}, options);
      ADD_FAILURE() << "no exception: " << line;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(), line);
    }
  };
  expect("radius must be at least the G-buffer's step of 6 where it upsamples, not 4", small.name(), large.name(), {});
  expect("occlusion must be of 11x9 pixels, not 63x50", large.name(), large.name(), {.radius = 6});
  expect("occlusion must be of 63x50 pixels, not 11x9", small.name(), small.name(), {.radius = 6});
}

}  // namespace
}  // namespace lkao::gl::tests::upsample_test
