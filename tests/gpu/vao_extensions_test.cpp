// What VAO++ adds: adaptive sets, culling, brightness, colours that bleed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "gpu/on_software.h"
#include "gpu/vao_definition.h"

namespace lkao::gl::tests::vao_extensions_test {
namespace {

constexpr int kWidth = 60;
constexpr int kHeight = 45;

// Flat but for a patch of waves on the right.
PixelView view_of_patch() {
  return view_of_ground(
      [](double x, double z) {
        return -1.2 + 0.15 * std::sin(9 * x) * std::cos(8 * z) * std::exp(-3 * std::pow(x - 1, 2));
      },
      kWidth, kHeight);
}

class VaoExtensions : public OnSoftware {
 protected:
  void SetUp() override {
    OnSoftware::SetUp();
    if (IsSkipped()) return;
    pass_ = std::make_unique<VaoPass>(VaoPassSetup{.count = true});
  }
  void TearDown() override { pass_.reset(); }

  // In how many pixels it is not what a definition says, of those with a receiver.
  template <typename Expected>
  std::size_t count_off(const PixelView& view, const VaoOptions& options, const Expected& expected) {
    const std::vector<float> drawn = draw_vao(view, *pass_, options);
    std::size_t off_count = 0;
    for (int y = 0; y < view.height(); ++y) {
      for (int x = 0; x < view.width(); ++x) {
        const auto i = static_cast<std::size_t>(y * view.width() + x);
        if (!view.pixels()[i].is_there()) continue;
        off_count += !(std::fabs(double{drawn[i]} - expected(x, y)) < 1e-3);
      }
    }
    return off_count;
  }

  std::unique_ptr<VaoPass> pass_;
};

TEST_F(VaoExtensions, WhatIsFarTakesSmallerSets) {
  const PixelView view = view_of_patch();
  const VaoDefinition definition(view);
  for (const int largest : {8, 32}) {
    VaoOptions options = plain_set(0.8f, largest);
    options.fewest_samples_width = 0.06f;
    std::vector<std::size_t> counts(33);
    const std::size_t off_count = count_off(view, options, [&](int x, int y) {
      const int size = definition.set_size(x, y, options);
      ++counts[static_cast<std::size_t>(size)];
      return definition.occlusion(x, y, options, VaoDefinition::set_of(x, y, size));
    });
    EXPECT_LE(off_count, 5u);
    std::size_t sample_count = 0;
    for (std::size_t size = 2; size <= static_cast<std::size_t>(largest); size *= 2) {
      EXPECT_GT(counts[size], 30u) << size;
      sample_count += size * counts[size];
    }
    // Those that fell beyond the picture were not taken.
    EXPECT_LE(pass_->read_counts().samples, sample_count);
    EXPECT_GT(pass_->read_counts().samples, 0.8 * static_cast<double>(sample_count));
  }
}

// Sec. 4.2 once more: the occlusion of a pixel of each tile, -1 where it shows nothing.
std::vector<double> tiles_of(const PixelView& view, const VaoOptions& options, int columns, int rows) {
  const VaoDefinition definition(view);
  std::vector<double> tiles;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int x = std::min(8 * column + 4, view.width() - 1), y = std::min(8 * row + 4, view.height() - 1);
      tiles.push_back(definition.seen(x, y).is_there()
                          ? definition.occlusion(x, y, options, VaoDefinition::set_of(column, row, 8))
                          : -1);
    }
  }
  return tiles;
}

TEST_F(VaoExtensions, TilesWithNothingInTheWayAreCulled) {
  const PixelView view = view_of_patch();
  const VaoDefinition definition(view);
  constexpr int kColumns = (kWidth + 7) / 8, kRows = (kHeight + 7) / 8;
  for (const VaoCulling culling : {VaoCulling::greedy, VaoCulling::careful}) {
    VaoOptions options = plain_set(0.5f, 16);
    options.culling = culling;
    const std::vector<double> tiles = tiles_of(view, options, kColumns, kRows);
    std::size_t culled_count = 0, receiver_count = 0;
    const auto expected = [&](int x, int y) {
      const int column = x / 8, row = y / 8;
      bool is_culled = tiles[static_cast<std::size_t>(row * kColumns + column)] >= 0;
      for (int r = std::max(row - 1, 0); r <= std::min(row + 1, kRows - 1); ++r) {
        for (int c = std::max(column - 1, 0); c <= std::min(column + 1, kColumns - 1); ++c) {
          is_culled = is_culled && tiles[static_cast<std::size_t>(r * kColumns + c)] <= 1.0 / 512;
        }
      }
      ++receiver_count;
      culled_count += is_culled;
      if (is_culled && culling == VaoCulling::greedy) return 0.0;
      return definition.occlusion(x, y, options, VaoDefinition::set_of(x, y, is_culled ? 4 : 16));
    };
    EXPECT_LE(count_off(view, options, expected), 4u);
    const VaoCounts counts = pass_->read_counts();
    EXPECT_EQ(counts.receivers, receiver_count);
    EXPECT_EQ(counts.culled, culled_count);
    EXPECT_GT(culled_count, receiver_count / 4);
    EXPECT_LT(culled_count, receiver_count);
    const std::uint64_t with_culling = counts.samples;
    options.culling = VaoCulling::off;
    draw_vao(view, *pass_, options);
    EXPECT_EQ(pass_->read_counts().culled, 0u);
    EXPECT_LT(with_culling, pass_->read_counts().samples * 9 / 10);
  }
}

// A small thing where no tile looks.
TEST_F(VaoExtensions, CarefulCullingSeesWhatGreedyLoses) {
  const PixelView flat = view_of_ground([](double, double) { return -1.2; }, kWidth, kHeight);
  std::vector<SeenPixel> pixels = flat.pixels();
  for (const int x : {24, 25}) {
    for (const int y : {8, 9}) {
      SeenPixel& pixel = pixels[static_cast<std::size_t>(y * kWidth + x)];
      pixel.position *= 0.93;  // towards the eye
    }
  }
  const PixelView view(flat.camera(), kWidth, kHeight, pixels);
  const auto sum_with = [&](VaoCulling culling) {
    double sum = 0;
    VaoOptions options = plain_set(0.3f, 16);
    options.culling = culling;
    for (const float value : draw_vao(view, *pass_, options)) sum += double{value};
    return sum;
  };
  const double all = sum_with(VaoCulling::off);
  EXPECT_GT(all, 0.3);
  EXPECT_EQ(sum_with(VaoCulling::greedy), 0);
  EXPECT_GT(sum_with(VaoCulling::careful), 0.2 * all);
}

std::vector<glm::vec4> random_colours(std::uint64_t seed) {
  lut::RandomStream random(seed);
  std::vector<glm::vec4> colours;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    colours.emplace_back(random.next_double(), random.next_double(), random.next_double(), 1);
  }
  return colours;
}

TEST_F(VaoExtensions, BrightSurfacesAreDarkenedLess) {
  const PixelView view = view_of_patch();
  const std::vector<glm::vec4> colours = random_colours(5);
  const Texture texture = make_image(GL_RGBA32F, kWidth, kHeight, &colours[0].x);
  GBuffer g_buffer = view.g_buffer();
  g_buffer.colours = texture.name();
  VaoOptions options = plain_set(0.5f, 16);
  const std::vector<float> plain = draw_vao(view, *pass_, options);
  for (const Brightness brightness : {Brightness::luminance, Brightness::value}) {
    for (const float sigma : {1.0f, 2.5f}) {
      options.luminance = {.threshold = 0.6f, .width = 0.25f, .sigma = sigma, .brightness = brightness};
      const auto draw = [&](const OcclusionTarget& to) { pass_->draw(g_buffer, view.camera(), options, to); };
      const std::vector<float> drawn = view.draw(draw);
      std::size_t less_count = 0, none_count = 0;
      for (std::size_t i = 0; i < drawn.size(); ++i) {
        const glm::dvec4 c(colours[i]);
        const double bright =
            brightness == Brightness::value ? std::max({c.x, c.y, c.z}) : 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
        // Eq. 3, as it must be.
        const double fallen = std::clamp((bright - 0.6 + 0.25) / 0.5, 0.0, 1.0);
        ASSERT_NEAR(drawn[i], plain[i] * std::pow(1 - fallen, double{sigma}), 1e-4);
        less_count += drawn[i] < 0.9f * plain[i];
        none_count += drawn[i] == 0 && plain[i] > 0;
      }
      EXPECT_GT(less_count, 100u);
      EXPECT_GT(none_count, 5u);
    }
  }
}

TEST_F(VaoExtensions, ColoursBleedByEquation5) {
  const PixelView view = view_of_patch();
  const VaoDefinition definition(view);
  const std::vector<glm::vec4> colours = random_colours(6);
  const Texture texture = make_image(GL_RGBA32F, kWidth, kHeight, &colours[0].x);
  const Texture occlusion = make_image(GL_R32F, kWidth, kHeight);
  const Texture bleeding = make_image(GL_RGBA32F, kWidth + 3, kHeight + 5);
  GBuffer g_buffer = view.g_buffer();
  g_buffer.colours = texture.name();
  for (const int stride : {1, 2, 4}) {
    VaoOptions options = plain_set(1, 32);
    options.bleeding_stride = stride;
    const BleedingTarget target{bleeding.name(), Part{2, 4}};
    pass_->draw(g_buffer, view.camera(), options, {occlusion.name()}, &target);
    const std::vector<glm::vec4> texels = read_image(bleeding.name(), kWidth + 3, kHeight + 5);
    std::size_t off_count = 0, coloured_count = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const glm::vec4 texel = texels[static_cast<std::size_t>((y + 4) * (kWidth + 3) + x + 2)];
        const SeenPixel& receiver = definition.seen(x, y);
        if (!receiver.is_there()) {
          EXPECT_EQ(texel, glm::vec4(1));
          continue;
        }
        const std::vector<glm::dvec2> places = VaoDefinition::set_of(x, y, 32);
        glm::dvec3 sum(0);
        int count = 0;
        for (std::size_t i = 0; i < places.size(); i += static_cast<std::size_t>(stride)) {
          const auto pixel = definition.pixel_of(definition.ball(x, y, options), places[i]);
          if (!pixel) continue;
          const glm::dvec3 to = definition.seen(pixel->x, pixel->y).position - receiver.position;
          const double away = glm::length(to);
          const bool counts = definition.seen(pixel->x, pixel->y).is_there() && away > 0 && away < 1;
          const double share =
              counts ? std::fmax(glm::dot(to, glm::normalize(receiver.normal)) / away, 0) * (1 - away) * (1 - away) : 0;
          sum += glm::mix(glm::dvec3(1), glm::dvec3(colours[static_cast<std::size_t>(pixel->y * kWidth + pixel->x)]),
                          share);
          ++count;
        }
        const glm::dvec3 expected = count > 0 ? sum / double(count) : glm::dvec3(1);
        off_count += !(glm::length(glm::dvec3(texel) - expected) < 2e-3) || texel.w != 1;
        coloured_count += glm::length(expected - glm::dvec3(1)) > 0.01;
      }
    }
    EXPECT_LE(off_count, 5u) << stride;
    EXPECT_GT(coloured_count, 100u);
  }
}

// What 3 x 3 pixels find differs by their samples alone; the kit's filter of three pixels joins them.
TEST_F(VaoExtensions, TheFilterJoinsInterleavedPixels) {
  const PixelView view = view_of_ground(
      [](double x, double z) { return -1.2 + 0.3 * std::sin(2 * x) * std::cos(2 * z); }, kWidth, kHeight);
  const std::vector<float> limit = draw_vao(view, *pass_, converged_vao(1));
  const Texture target = make_image(GL_R32F, kWidth, kHeight);
  BilateralFilter filter;
  const auto error_of = [&](int radius) {
    pass_->draw(view.g_buffer(), view.camera(), plain_set(1, 4), {target.name()});
    if (radius > 0) filter.filter(view.g_buffer(), view.camera(), {target.name()}, {target.name()}, {.radius = radius});
    double squares = 0;
    const std::vector<glm::vec4> texels = read_image(target.name(), kWidth, kHeight);
    for (std::size_t i = 0; i < texels.size(); ++i) squares += std::pow(double{texels[i].x} - double{limit[i]}, 2);
    return std::sqrt(squares / static_cast<double>(texels.size()));
  };
  EXPECT_LT(error_of(3), 0.6 * error_of(0));
}

}  // namespace
}  // namespace lkao::gl::tests::vao_extensions_test
