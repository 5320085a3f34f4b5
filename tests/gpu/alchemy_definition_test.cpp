// The Alchemy pass computes its definition: with many samples the integral over all pixels of the disc, with few the
// same on average.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gpu/alchemy_definition.h"
#include "gpu/on_software.h"
#include "support/sanitized.h"

namespace lkao::gl::tests::alchemy_definition_test {
namespace {

constexpr int kWidth = 40;
constexpr int kHeight = 30;
constexpr int kManySamples = 8192;
constexpr DiscPattern kPatterns[] = {DiscPattern::jittered, DiscPattern::spiral, DiscPattern::even_spiral};
constexpr ObscuranceFalloff kFalloffs[] = {ObscuranceFalloff::cut_off, ObscuranceFalloff::smooth,
                                           ObscuranceFalloff::medium, ObscuranceFalloff::low};

PixelView view_of_waves() {
  return view_of_ground([](double x, double z) { return -1.2 + 0.15 * std::sin(6 * x) * std::cos(5 * z); }, kWidth,
                        kHeight);
}

Camera parallel_camera() {
  Camera camera = straight_camera();
  camera.projection = glm::ortho(-4.0f, 4.0f, -3.0f, 3.0f, 0.1f, 20.0f);
  return camera;
}

// Looks past the middle, at pixels that are not square, and sees the world mirrored.
Camera skewed_camera() {
  Camera camera{glm::rotate(glm::mat4(1), 0.4f, glm::vec3(0.3f, 1, 0.2f)),
                glm::frustum(-0.05f, 0.02f, -0.01f, 0.06f, 0.1f, 50.0f)};
  camera.projection[0] = -camera.projection[0];
  return camera;
}

AlchemyOptions with_many_samples(AlchemyOptions options) {
  options.samples_per_band = kManySamples;
  options.max_band_count = 1;
  options.spiral_turns = 0.381966f * kManySamples;
  return options;
}

struct Differences {
  double mean = 0, rms = 0, largest = 0;
  double expected_mean = 0;
};

Differences compare(const std::vector<float>& drawn, const std::vector<double>& expected) {
  Differences differences;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const double off = drawn[i] - expected[i];
    differences.mean += off;
    differences.rms += off * off;
    differences.largest = std::fmax(differences.largest, std::fabs(off));
    differences.expected_mean += expected[i];
  }
  const auto count = static_cast<double>(drawn.size());
  differences.mean /= count;
  differences.rms = std::sqrt(differences.rms / count);
  differences.expected_mean /= count;
  return differences;
}

class AlchemyOfPixels : public OnSoftware {
 protected:
  void SetUp() override {
    OnSoftware::SetUp();
    if (IsSkipped()) return;
    pass_ = std::make_unique<AlchemyPass>();
  }
  void TearDown() override { pass_.reset(); }

  std::vector<float> draw(const PixelView& view, const AlchemyOptions& options, int step = 1) {
    GBuffer textures = view.g_buffer();
    textures.step = step;
    return view.draw([&](const OcclusionTarget& to) { pass_->draw(textures, view.camera(), options, to); }, step);
  }

  void expect_definition(const PixelView& view, const AlchemyOptions& options, int step = 1) {
    const Differences found =
        compare(draw(view, with_many_samples(options), step), AlchemyDefinition(view, step).occlusion(options));
    EXPECT_GT(found.expected_mean, 0.02);
    EXPECT_LT(found.expected_mean, 0.9);
    EXPECT_LT(std::fabs(found.mean), 1e-3);
    EXPECT_LT(found.rms, 4e-3);
    EXPECT_LT(found.largest, 0.02);
  }

  std::unique_ptr<AlchemyPass> pass_;
};

TEST_F(AlchemyOfPixels, IsTheIntegralOverTheDisc) {
  const PixelView waves = view_of_waves();
  for (const DiscPattern pattern : kPatterns) {
    SCOPED_TRACE("pattern " + std::to_string(static_cast<int>(pattern)));
    expect_definition(waves, {.radius = 0.5f, .intensity = 1, .pattern = pattern});
  }
  for (const ObscuranceFalloff falloff : kFalloffs) {
    SCOPED_TRACE("falloff " + std::to_string(static_cast<int>(falloff)));
    expect_definition(
        waves,
        {.radius = 0.4f, .intensity = 1.3f, .bias = 0.003f, .epsilon = 0.02f, .contrast = 1.7f, .falloff = falloff});
  }
}

// Points that are no surface: everywhere in front of the receivers, many beyond the radius.
TEST_F(AlchemyOfPixels, IsSoForEveryCamera) {
  for (const Camera& camera : {straight_camera(), parallel_camera(), skewed_camera()}) {
    const PixelView view = random_view(camera, kWidth, kHeight, 9);
    expect_definition(view, {.radius = 2, .intensity = 1, .bias = 0.01f});
  }
}

TEST_F(AlchemyOfPixels, IsSoOfEveryNthPixel) {
  for (const Camera& camera : {skewed_camera(), parallel_camera()}) {
    const PixelView view = random_view(camera, 2 * kWidth + 1, 2 * kHeight - 1, 10);
    for (const int step : {2, 3}) expect_definition(view, {.radius = 2, .intensity = 1, .bias = 0.05f}, step);
  }
}

// The mean over seeds, where nothing ends at 0: no pixel may be farther off than its own spread lets it.
TEST_F(AlchemyOfPixels, OfFewSamplesIsRightOnAverage) {
  const PixelView view = view_of_waves();
  AlchemyOptions options{.radius = 0.5f, .intensity = 0.02f};
  const std::vector<double> expected = AlchemyDefinition(view).occlusion(options);
  constexpr int kSeedCount = lkao::tests::kIsSanitized ? 100 : 300;
  std::vector<double> sums(expected.size()), squares(expected.size());
  for (int seed = 0; seed < kSeedCount; ++seed) {
    options.seed = static_cast<std::uint32_t>(seed);
    const std::vector<float> drawn = draw(view, options);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      sums[i] += drawn[i];
      squares[i] += double{drawn[i]} * drawn[i];
    }
  }
  double squared_offs = 0, off = 0, variance_of_all = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const double mean = sums[i] / kSeedCount, variance = squares[i] / kSeedCount - mean * mean;
    if (expected[i] < 1e-3) continue;
    off += mean - expected[i];
    variance_of_all += variance / kSeedCount;
    squared_offs += (mean - expected[i]) * (mean - expected[i]) * kSeedCount / variance;
    ++count;
  }
  EXPECT_GT(count, expected.size() / 10);
  EXPECT_LT(std::fabs(off), 4 * std::sqrt(variance_of_all));
  EXPECT_NEAR(squared_offs / static_cast<double>(count), 1, 0.3);
}

// How the error falls with the number of samples, for each pattern: on the waves, as a power of it.
TEST_F(AlchemyOfPixels, ComesNearerWithMoreSamples) {
  const PixelView view = view_of_waves();
  for (const DiscPattern pattern : kPatterns) {
    AlchemyOptions options{.radius = 0.5f, .intensity = 0.3f, .max_band_count = 1, .pattern = pattern};
    const std::vector<double> expected = AlchemyDefinition(view).occlusion(options);
    std::vector<double> errors;
    for (const int count : {4, 16, 64, 256, 1024}) {
      options.samples_per_band = count;
      options.spiral_turns = 0.381966f * static_cast<float>(count);
      errors.push_back(compare(draw(view, options), expected).rms);
      if (errors.size() > 1) {
        EXPECT_LT(errors.back(), 0.6 * errors[errors.size() - 2]) << count;
      }
    }
    const double slope = std::log(errors.back() / errors.front()) / std::log(256.0);
    const std::string name = std::to_string(static_cast<int>(pattern));
    RecordProperty("slope_of_pattern_" + name, std::to_string(slope));
    RecordProperty("error_of_16_of_pattern_" + name, std::to_string(errors[1]));
    EXPECT_LT(slope, -0.5);
  }
}

TEST_F(AlchemyOfPixels, SamplesDifferFromPixelToPixelAndSeedToSeed) {
  const PixelView view = view_of_waves();
  for (const DiscPattern pattern : kPatterns) {
    AlchemyOptions options{.radius = 0.5f, .pattern = pattern};
    const std::vector<float> first = draw(view, options);
    EXPECT_EQ(draw(view, options), first);
    options.seed = 1;
    EXPECT_NE(draw(view, options), first);
  }
}

// The radius is some 18 pixels at distance 1, so the disc is of a size that falls with the distance.
TEST_F(AlchemyOfPixels, TakesABandLessForEachHalvingOfTheDisc) {
  const glm::dvec3 towards(0, 0, 1);
  const Camera camera = straight_camera();
  for (const double distance : {1.0, 1.9, 2.1, 3.9, 4.1, 7.9, 8.1}) {
    std::vector<SeenPixel> pixels(std::size_t{kWidth} * kHeight);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const glm::dvec3 nearer = seen_at(camera, kWidth, kHeight, x, y, distance - 0.1 * ((x + y) % 3));
        pixels[static_cast<std::size_t>(y * kWidth + x)] = {nearer, towards, towards};
      }
    }
    const PixelView view(camera, kWidth, kHeight, pixels);
    AlchemyOptions options{.radius = 0.6f, .intensity = 0.1f, .samples_per_band = 5, .max_band_count = 4};
    options.full_radius = static_cast<float>(options.radius / view.pixel_width({0, 0, -1.0}));
    const std::vector<float> drawn = draw(view, options);
    // The nearest of the three kinds of pixels may be a band ahead: those at `distance` itself are compared.
    const int band_count = distance <= 1 ? 4 : distance < 2 ? 3 : distance < 4 ? 2 : 1;
    AlchemyOptions plain = options;
    plain.max_band_count = 1;
    plain.samples_per_band = 5 * band_count;
    const std::vector<float> expected = draw(view, plain);
    std::size_t count = 0, wrong_count = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        if ((x + y) % 3 != 0) continue;
        const auto i = static_cast<std::size_t>(y * kWidth + x);
        wrong_count += drawn[i] != expected[i];
        count += drawn[i] > 0;
      }
    }
    EXPECT_EQ(wrong_count, 0u) << distance;
    EXPECT_GT(count, 100u) << distance;
  }
}

}  // namespace
}  // namespace lkao::gl::tests::alchemy_definition_test
