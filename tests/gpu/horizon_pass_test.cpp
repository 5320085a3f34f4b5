// The horizon pass against its definition in double precision, all kinds of pictures, its mistakes.
#include <gmock/gmock.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "gpu/expect_error.h"
#include "gpu/horizon_scene.h"
#include "gpu/on_software.h"
#include "gpu/pass_scene.h"
#include "support/sanitized.h"

namespace lkao::gl::tests::horizon_pass_test {
namespace {

using testing::Each;
using testing::HasSubstr;

constexpr int kWidth = lkao::tests::kIsSanitized ? 24 : 40;
constexpr int kHeight = lkao::tests::kIsSanitized ? 18 : 30;

PixelView view_of_waves(int width = kWidth, int height = kHeight) {
  return view_of_ground([](double x, double z) { return -1.2 + 0.15 * std::sin(6 * x) * std::cos(5 * z); }, width,
                        height);
}

std::vector<Camera> all_cameras() {
  const glm::mat4 view = glm::lookAt(glm::vec3(1, 2, 5), glm::vec3(0.5f, 1, 0), glm::vec3(0.1f, 1, 0));
  const glm::mat4 perspective = glm::perspective(1.1f, 4.0f / 3, 0.1f, 50.0f);
  const glm::mat4 turned(glm::mat4_cast(glm::angleAxis(0.7f, glm::vec3(0, 0, 1))));
  glm::mat4 reversed(0);  // far plane at infinity
  reversed[0][0] = 1.2f, reversed[1][1] = -1.6f, reversed[2][3] = -1, reversed[3][2] = 0.1f;
  return {{view, perspective},
          {view, turned * perspective},
          {view, glm::frustum(-0.02f, 0.08f, -0.01f, 0.05f, 0.1f, 20.0f)},
          {view, reversed, ClipDepth::zero_to_one},
          {view, turned * glm::ortho(-4.0f, 4.0f, -3.0f, 3.0f, 0.1f, 20.0f)}};
}

std::vector<HorizonOptions> all_options() {
  std::vector<HorizonOptions> all;
  for (const HorizonEstimator estimator : kEstimators) {
    const HorizonOptions usual{.estimator = estimator, .radius = 2.5f, .slice_count = 3, .step_count = 8};
    for (const auto& change : std::vector<std::function<void(HorizonOptions&)>>{
             [](HorizonOptions&) {}, [](HorizonOptions& o) { o.thickness = 0.4f, o.seed = 77; },
             [](HorizonOptions& o) { o.falloff_begin = 0, o.thickness = 3, o.step_exponent = 1; },
             [](HorizonOptions& o) { o.slice_density = SliceDensity::even, o.screen_radius = 9, o.angle_bias = 0.2f; },
             [](HorizonOptions& o) { o.sector_measure = SectorMeasure::angle, o.step_count = 50, o.radius = 9; },
             [](HorizonOptions& o) {
               o.sector_measure = SectorMeasure::angle, o.slice_density = SliceDensity::even, o.thickness = 1;
             }}) {
      all.push_back(usual);
      change(all.back());
    }
  }
  return all;
}

class Horizons : public OnSoftware {
 protected:
  void SetUp() override {
    OnSoftware::SetUp();
    if (IsSkipped()) return;
    pass_ = std::make_unique<HorizonPass>();
  }
  void TearDown() override { pass_.reset(); }

  // Rounding may choose another pixel or sector now and then. Returns the mean.
  double expect_definition(const PixelView& view, const HorizonOptions& options) {
    const HorizonDefinition definition(view, options);
    const std::vector<float> drawn = draw_horizons(view, *pass_, options);
    std::size_t count = 0, off_count = 0;
    double sum = 0, off_sum = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      if (!view.pixels()[i].is_there()) continue;
      const double expected = definition.of(i), off = std::fabs(drawn[i] - expected);
      sum += expected, off_sum += off, ++count;
      off_count += !(off < 1e-3);
    }
    const auto all = static_cast<double>(count);
    EXPECT_LT(static_cast<double>(off_count), 0.04 * all);
    EXPECT_LT(off_sum / all, 1e-3);
    return sum / all;
  }

  std::unique_ptr<HorizonPass> pass_;
};

TEST(HorizonSlices, HoldEqualMeasures) {
  for (const double c : {0.05, 0.4, 0.8, 1.0}) {
    // The share of directions below a slice, by adding up cosines over all slices, and over the angles of each.
    constexpr int kCount = 400;
    const double s = std::sqrt(1 - c * c);
    double below = 0;
    for (int i = 0; i < kCount; ++i) {
      const double azimuth = std::numbers::pi * ((i + 0.5) / kCount - 0.5);
      for (int j = 0; j < kCount; ++j) {
        const double angle = std::numbers::pi * (2 * (j + 0.5) / kCount - 1);
        const double cosine = c * std::cos(angle) + s * std::cos(azimuth) * std::sin(angle);
        below += std::fmax(cosine, 0) * std::fabs(std::sin(angle)) * 2 * std::numbers::pi / (kCount * kCount);
      }
      if (i % 50 != 37) continue;
      EXPECT_NEAR(slice_azimuth(below, c), azimuth + 0.5 * std::numbers::pi / kCount, 3e-3);
    }
    EXPECT_NEAR(below, 1, 1e-4);
  }
}

TEST_F(Horizons, AreTheirDefinition) {
  // Points that are no surface: occluders everywhere, normals that look away from the eye.
  for (const Camera& camera : all_cameras()) {
    const PixelView view = random_view(camera, kWidth, kHeight, 9);
    int number = 0;
    for (const HorizonOptions& options : all_options()) {
      SCOPED_TRACE(number++);
      EXPECT_GT(expect_definition(view, options), 0.02);
    }
  }
  for (HorizonOptions options : all_options()) {
    options.radius = 1;
    EXPECT_GT(expect_definition(view_of_waves(), options), 0.005);
  }
}

TEST_F(Horizons, ConvergeToAllPixelsOfAllSlices) {
  const PixelView waves = view_of_waves(), points = random_view(all_cameras()[1], kWidth, kHeight, 5);
  for (const HorizonEstimator estimator : kEstimators) {
    const HorizonOptions options{.estimator = estimator, .radius = 1.2f, .thickness = 0.5f, .falloff_begin = 0.5f};
    for (const PixelView* view : {&waves, &points}) {
      const HorizonDefinition definition(*view, options);
      const std::vector<double> drawn = draw_converged(*view, *pass_, options, 8);
      double squares = 0, sum = 0;
      int count = 0;
      for (std::size_t i = 3; i < drawn.size(); i += 17) {
        if (!view->pixels()[i].is_there()) continue;
        const double expected = definition.converged(i, 256);
        squares += (drawn[i] - expected) * (drawn[i] - expected), sum += expected, ++count;
      }
      EXPECT_GT(sum / count, 0.01);
      EXPECT_LT(std::sqrt(squares / count), 0.004);
    }
  }
}

// The mean over consecutive seeds nears the limit faster than independent frames would, by 1 / sqrt(n).
TEST_F(Horizons, OfConsecutiveSeedsFillEachOthersGaps) {
  const PixelView view = view_of_waves();
  for (const HorizonEstimator estimator : kEstimators) {
    HorizonOptions options{.estimator = estimator, .radius = 1, .slice_count = 1, .thickness = 0.5f};
    options.step_count = kWidth;
    const std::vector<double> limit = draw_converged(view, *pass_, options, 8);
    const auto rmse = [&](int seed_count) {
      const std::vector<double> drawn = draw_mean(view, *pass_, options, seed_count);
      double squares = 0;
      for (std::size_t i = 0; i < drawn.size(); ++i) squares += (drawn[i] - limit[i]) * (drawn[i] - limit[i]);
      return std::sqrt(squares / static_cast<double>(drawn.size()));
    };
    const double one = rmse(1), sixteen = rmse(16);
    RecordProperty(estimator == HorizonEstimator::bitmask ? "bitmask" : "horizons",
                   std::to_string(one) + ", 16 seeds " + std::to_string(sixteen));
    EXPECT_LT(sixteen, 0.2 * one);
  }
}

TEST_F(Horizons, LeavePlanesOpenAtAnyAngle) {
  Camera parallel = straight_camera();
  parallel.projection = glm::ortho(-4.0f, 4.0f, -3.0f, 3.0f, 0.1f, 20.0f);
  for (const auto& [slope_x, slope_z] : {std::pair{0.0, 0.0}, {0.5, 0.3}, {-1.5, 0.1}, {0.2, -0.05}, {0.02, 0.6}}) {
    const PixelView flat =
        view_of_ground([a = slope_x, b = slope_z](double x, double z) { return -1.5 + a * x + b * z; }, 64, 48);
    std::vector<SeenPixel> tilted = flat.pixels();
    for (SeenPixel& pixel : tilted) {
      if (pixel.is_there()) pixel.normal = glm::normalize(pixel.normal + glm::dvec3(0.3, 0.1, -0.2));
    }
    const PixelView shaded(flat.camera(), 64, 48, tilted);
    for (const HorizonEstimator estimator : kEstimators) {
      const HorizonOptions options{.estimator = estimator, .radius = 2};
      EXPECT_THAT(draw_horizons(flat, *pass_, options), Each(testing::FloatNear(0, 1e-6f)))
          << slope_x << ' ' << slope_z;
      EXPECT_THAT(draw_horizons(shaded, *pass_, options), Each(testing::FloatNear(0, 1e-6f)));
    }
  }
}

TEST_F(Horizons, TakeAnyGBuffer) {
  const Mesh mesh = furnished_room();
  const glm::mat4 view = room_camera(kWidth, kHeight).view;
  glm::mat4 reversed(0);  // far plane at infinity
  reversed[0][0] = 1.1f, reversed[1][1] = 1.1f * kWidth / kHeight, reversed[2][3] = -1, reversed[3][2] = 0.05f;
  glm::mat4 standard = glm::infinitePerspective(1.0f, 1.0f, 0.05f);
  standard[0][0] = reversed[0][0], standard[1][1] = reversed[1][1];
  const Camera cameras[] = {{view, standard}, {view, reversed, ClipDepth::zero_to_one}};
  const Texture target = make_image(GL_R32F, kWidth, kHeight);
  for (const HorizonEstimator estimator : kEstimators) {
    std::vector<std::vector<float>> all;
    for (const Camera& camera : cameras) {
      const GBufferPass g_buffer(mesh, camera, kWidth, kHeight);
      for (const GBuffer& textures :
           {g_buffer.by_positions(), g_buffer.by_depth(), g_buffer.by_linear_depth(), g_buffer.by_view_positions()}) {
        HorizonOptions options{.estimator = estimator, .radius = 1.5f, .thickness = 0.8f};
        options.slice_count = 16;
        pass_->draw(textures, camera, options, {target.name()});
        all.emplace_back();
        for (const glm::vec4& texel : read_image(target.name(), kWidth, kHeight)) all.back().push_back(texel.x);
      }
    }
    double sum = 0;
    for (const float value : all[0]) sum += value;
    EXPECT_GT(sum / (kWidth * kHeight), 0.1);
    for (const std::vector<float>& other : all) {
      double off = 0;
      for (std::size_t i = 0; i < other.size(); ++i) off += std::fabs(other[i] - all[0][i]);
      EXPECT_LT(off / (kWidth * kHeight), 1e-3);
    }
  }
}

// The camera turned by 90 degrees, and mirrored: the same picture, turned and mirrored.
TEST_F(Horizons, TurnWithTheCamera) {
  const PixelView view = view_of_waves(36, 36);
  constexpr int kSide = 36;
  glm::mat4 turn(1), mirror(1);
  turn[0] = {0, 1, 0, 0}, turn[1] = {-1, 0, 0, 0}, mirror[0][0] = -1;
  // Where pixel (x, y) goes.
  const auto turned = [](int x, int y) { return x * kSide + (kSide - 1 - y); };
  const auto mirrored = [](int x, int y) { return y * kSide + (kSide - 1 - x); };
  const std::pair<glm::mat4, std::function<int(int, int)>> cases[] = {{turn, turned}, {mirror, mirrored}};
  for (const auto& [change, moved] : cases) {
    Camera camera = view.camera();
    camera.projection = change * camera.projection;
    std::vector<SeenPixel> pixels(view.pixels().size());
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        pixels[static_cast<std::size_t>(moved(x, y))] = view.pixels()[static_cast<std::size_t>(y * kSide + x)];
      }
    }
    const PixelView other(camera, kSide, kSide, pixels);
    for (const HorizonEstimator estimator : kEstimators) {
      const HorizonOptions options{.estimator = estimator, .radius = 1, .thickness = 0.5f};
      const std::vector<double> before = draw_converged(view, *pass_, options, 4),
                                after = draw_converged(other, *pass_, options, 4);
      double off = 0, sum = 0;
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
          const double value = before[static_cast<std::size_t>(y * kSide + x)];
          off += std::fabs(after[static_cast<std::size_t>(moved(x, y))] - value), sum += value;
        }
      }
      EXPECT_GT(sum, 10);
      EXPECT_LT(off, 0.03 * sum);
    }
  }
}

TEST_F(Horizons, AreOfEverySizeAndStepAndPart) {
  const HorizonOptions options{.radius = 1};
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 1}, {17, 33}, {203, 101}}) {
    const PixelView view = random_view(room_camera(width, height), width, height, 2);
    const std::vector<float> drawn = view.draw(
        [&](const OcclusionTarget& to) { pass_->draw(view.g_buffer(), view.camera(), options, to); }, 1, GL_R32F, 0.5f);
    std::size_t wrong_count = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      wrong_count += view.pixels()[i].is_there() ? !(drawn[i] >= 0 && drawn[i] <= 1) : drawn[i] != 0.5f;
    }
    EXPECT_EQ(wrong_count, 0u) << width << 'x' << height;
  }
  // Every second pixel, in part of a texture, as the picture of just these pixels is.
  const PixelView view = view_of_waves(kWidth, kHeight);
  for (const int step : {2, 3}) {
    GBuffer textures = view.g_buffer();
    textures.step = step;
    const int width = textures.picture_width(), height = textures.picture_height();
    const Texture target = make_image(GL_RGBA16F, width + 5, height + 9);
    const OcclusionTarget to{target.name(), -1, Quantity::visibility, Channel::green, Part{3, 7}};
    pass_->draw(textures, view.camera(), converging(options, view), to);
    const std::vector<glm::vec4> texels = read_image(target.name(), width + 5, height + 9);
    const std::vector<float> whole = draw_horizons(view, *pass_, converging(options, view));
    double off = 0, sum = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const std::size_t i = static_cast<std::size_t>(step * y * kWidth + step * x);
        const glm::vec4& texel = texels[static_cast<std::size_t>((y + 7) * (width + 5) + x + 3)];
        EXPECT_EQ(texel.x, 0);
        if (!view.pixels()[i].is_there()) {
          EXPECT_EQ(texel.y, -1);
          continue;
        }
        off += std::fabs(1 - texel.y - whole[i]), sum += whole[i];
      }
    }
    EXPECT_GT(sum, 1);
    EXPECT_LT(off, 0.7 * sum) << "coarser pixels see less";
  }
}

TEST_F(Horizons, OfAnEmptySceneAreTheBackground) {
  const Camera camera = room_camera(kWidth, kHeight);
  std::vector<SeenPixel> pixels(std::size_t{kWidth} * kHeight);
  const auto draw = [&](const PixelView& view) {
    return view.draw([&](const OcclusionTarget& to) { pass_->draw(view.g_buffer(), camera, {.radius = 1}, to); }, 1,
                     GL_R32F, 0.25f);
  };
  EXPECT_THAT(draw({camera, kWidth, kHeight, pixels}), Each(0.25f));
  // Pixels that are nowhere, with a normal.
  for (SeenPixel& pixel : pixels) {
    pixel = {glm::dvec3(std::numeric_limits<double>::quiet_NaN()), {0, 1, 0}, {0, 1, 0}};
  }
  EXPECT_THAT(draw({camera, kWidth, kHeight, pixels}), Each(0.25f));
}

TEST_F(Horizons, NameWhatIsWrong) {
  const PixelView view = view_of_waves();
  const Texture target = make_image(GL_R32F, kWidth, kHeight), small = make_image(GL_R32F, kWidth, kHeight - 1);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  struct Mistake {
    const char* name;
    std::function<void(HorizonOptions&)> make;
  };
  const Mistake mistakes[] = {{"radius", [](HorizonOptions& o) { o.radius = 0; }},
                              {"radius", [=](HorizonOptions& o) { o.radius = nan; }},
                              {"radius", [](HorizonOptions& o) { o.radius = 2e18f; }},
                              {"screen_radius", [](HorizonOptions& o) { o.screen_radius = 0; }},
                              {"slice_count", [](HorizonOptions& o) { o.slice_count = 0; }},
                              {"slice_count", [](HorizonOptions& o) { o.slice_count = 513; }},
                              {"step_count", [](HorizonOptions& o) { o.step_count = 0; }},
                              {"step_count", [](HorizonOptions& o) { o.step_count = 16385; }},
                              {"100 x 200", [](HorizonOptions& o) { o.slice_count = 100, o.step_count = 200; }},
                              {"step_exponent", [](HorizonOptions& o) { o.step_exponent = 0.5f; }},
                              {"thickness", [](HorizonOptions& o) { o.thickness = 0; }},
                              {"thickness", [=](HorizonOptions& o) { o.thickness = nan; }},
                              {"falloff_begin", [](HorizonOptions& o) { o.falloff_begin = 1.5f; }},
                              {"angle_bias", [](HorizonOptions& o) { o.angle_bias = -1; }}};
  const auto draw = [&](const HorizonOptions& options, const Texture& to) {
    pass_->draw(view.g_buffer(), view.camera(), options, {to.name()});
  };
  for (const Mistake& mistake : mistakes) {
    HorizonOptions options{.radius = 1};
    mistake.make(options);
    expect_error<std::invalid_argument>(mistake.name, [&] { draw(options, target); });
  }
  expect_error<std::invalid_argument>("occlusion must be of", [&] { draw({.radius = 1}, small); });
  for (const HorizonEstimator estimator : kEstimators) {
    EXPECT_NO_THROW(draw({.estimator = estimator, .radius = 1e18f}, target));
  }
}

TEST_F(Horizons, AreDrawnWithoutExceptions) {
  const PixelView view = view_of_waves();
  Status status;
  std::optional<HorizonPass> pass = HorizonPass::try_make({.host_errors = HostErrors::dropped}, status);
  ASSERT_TRUE(pass && status) << status.message;
  const Texture target = make_image(GL_R32F, kWidth, kHeight);
  glEnable(GL_TEXTURE_2D_ARRAY);  // an error that is dropped
  EXPECT_TRUE(pass->try_draw(view.g_buffer(), view.camera(), {.radius = 1}, {target.name()}));
  EXPECT_THAT(pass->try_draw(view.g_buffer(), view.camera(), {}, {target.name()}).message, HasSubstr("radius"));
  context_->release();
  EXPECT_FALSE(HorizonPass::try_make({}, status));
  EXPECT_THAT(status.message, HasSubstr("no OpenGL context"));
  EXPECT_TRUE(context_->try_make_current());
}

}  // namespace
}  // namespace lkao::gl::tests::horizon_pass_test
