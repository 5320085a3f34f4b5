// The VAO pass against its definition in double precision, for all cameras, sizes and G-buffers; its mistakes.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "gpu/expect_error.h"
#include "gpu/on_software.h"
#include "gpu/pass_scene.h"
#include "gpu/vao_definition.h"
#include "support/sanitized.h"

namespace lkao::gl::tests::vao_pass_test {
namespace {

using testing::Each;
using testing::HasSubstr;

constexpr int kWidth = 40;
constexpr int kHeight = 30;

Camera parallel_camera() { return {glm::mat4(1), glm::ortho(-4.0f, 4.0f, -3.0f, 3.0f, 0.1f, 20.0f)}; }

PixelView view_of_waves() {
  return view_of_ground([](double x, double z) { return -1.2 + 0.15 * std::sin(6 * x) * std::cos(5 * z); }, kWidth,
                        kHeight);
}

struct Off {
  double largest = 0, mean = 0, mean_expected = 0;
  std::size_t far_count = 0;  // by more than a thousandth
};

class Vao : public OnSoftware {
 protected:
  void SetUp() override {
    OnSoftware::SetUp();
    if (IsSkipped()) return;
    pass_ = std::make_unique<VaoPass>();
  }
  void TearDown() override { pass_.reset(); }

  // From the definition with the places that `places_of(x, y)` gives.
  template <typename Places>
  Off off(const PixelView& view, const VaoOptions& options, const Places& places_of, int step = 1) {
    const std::vector<float> drawn = draw_vao(view, *pass_, options, step, GL_R32F, -1);
    const VaoDefinition definition(view, step);
    Off result;
    std::size_t count = 0;
    for (int y = 0; y < definition.height(); ++y) {
      for (int x = 0; x < definition.width(); ++x) {
        const float value = drawn[static_cast<std::size_t>(y * definition.width() + x)];
        if (!definition.seen(x, y).is_there()) {
          EXPECT_EQ(value, -1);
          continue;
        }
        const double expected = definition.occlusion(x, y, options, places_of(x, y));
        const double error = std::fabs(double{value} - expected);
        result.largest = std::fmax(result.largest, error);
        result.mean += error;
        result.mean_expected += expected;
        result.far_count += !(error < 1e-3);
        ++count;
      }
    }
    result.mean /= static_cast<double>(count);
    result.mean_expected /= static_cast<double>(count);
    return result;
  }

  std::unique_ptr<VaoPass> pass_;
};

TEST_F(Vao, OfASetIsItsDefinition) {
  // Points that are no surface, behind and before each other, with normals of all directions.
  for (const Camera& camera : {straight_camera(), parallel_camera()}) {
    const PixelView view = random_view(camera, kWidth, kHeight, 9);
    for (const int size : kSampleSetSizes) {
      for (const float thickness : {0.03f, std::numeric_limits<float>::infinity()}) {
        VaoOptions options = plain_set(2, size);
        options.thickness = thickness;
        const Off off = this->off(view, options, [&](int x, int y) { return VaoDefinition::set_of(x, y, size); });
        // A place that lies on the edge of two pixels, to a rounding, may be in either.
        EXPECT_LE(off.far_count, 3u) << size;
        EXPECT_LT(off.mean, 5e-4);
        EXPECT_GT(off.mean_expected, 0.05);
      }
    }
  }
}

TEST_F(Vao, ConvergesToWhatAllPlacesOfTheDiscSee) {
  for (const Camera& camera : {straight_camera(), parallel_camera()}) {
    const PixelView view = camera.projection[2][3] != 0 ? view_of_waves() : random_view(camera, kWidth, kHeight, 3);
    const VaoDefinition definition(view);
    const std::vector<float> drawn = draw_vao(view, *pass_, converged_vao(1.5f));
    double largest = 0, sum = 0;
    constexpr int kStep = lkao::tests::unless_sanitized(1, 2);
    for (int y = 0; y < kHeight; y += kStep) {
      for (int x = 0; x < kWidth; x += kStep) {
        if (!definition.seen(x, y).is_there()) continue;
        const double expected = definition.converged(x, y, converged_vao(1.5f));
        largest = std::fmax(largest, std::fabs(drawn[static_cast<std::size_t>(y * kWidth + x)] - expected));
        sum += expected;
      }
    }
    EXPECT_LT(largest, 0.02);
    EXPECT_GT(sum, 5.0 / (kStep * kStep));
  }
}

TEST_F(Vao, IsNearerToItsLimitTheMoreSamplesItTakes) {
  const PixelView view = view_of_waves();
  const std::vector<float> limit = draw_vao(view, *pass_, converged_vao(1.5f));
  const auto error_of = [&](const VaoOptions& options) {
    const std::vector<float> drawn = draw_vao(view, *pass_, options);
    double squares = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) squares += std::pow(double{drawn[i]} - double{limit[i]}, 2);
    return std::sqrt(squares / static_cast<double>(drawn.size()));
  };
  double last = 1;
  for (const int size : kSampleSetSizes) {
    const double error = error_of(plain_set(1.5f, size));
    RecordProperty("rmse_of_" + std::to_string(size), std::to_string(error));
    EXPECT_LT(error, 0.85 * last) << size;
    last = error;
  }
  // The nine rotations are nearly nine times as many.
  VaoOptions sequence = plain_set(1.5f, 256);
  EXPECT_LT(error_of(sequence), 0.5 * last);
}

TEST_F(Vao, SeesAlikeThroughAllProjections) {
  const Mesh mesh = furnished_room();
  const float aspect = static_cast<float>(kWidth) / kHeight;
  Camera usual = room_camera(kWidth, kHeight);
  Camera reversed = usual, infinite = usual, parallel = usual, reversed_parallel = usual;
  usual.projection = glm::perspectiveRH_NO(1.0f, aspect, 0.1f, 20.0f);
  reversed.projection = glm::perspectiveRH_ZO(1.0f, aspect, 20.0f, 0.1f);
  reversed.clip_depth = ClipDepth::zero_to_one;
  infinite.projection = glm::perspectiveRH_ZO(1.0f, aspect, 0.1f, 20.0f);
  infinite.projection[2][2] = 0;
  infinite.projection[3][2] = 0.1f;
  infinite.clip_depth = ClipDepth::zero_to_one;
  parallel.projection = glm::orthoRH_NO(-2.0f, 2.0f, -1.5f, 1.5f, 0.1f, 20.0f);
  reversed_parallel.projection = glm::orthoRH_ZO(-2.0f, 2.0f, -1.5f, 1.5f, 20.0f, 0.1f);
  reversed_parallel.clip_depth = ClipDepth::zero_to_one;
  const auto draw = [&](const Camera& camera, bool by_depth) {
    const GBufferPass g_buffer(mesh, camera, kWidth, kHeight);
    const Texture target = make_image(GL_R32F, kWidth, kHeight);
    pass_->draw(by_depth ? g_buffer.by_depth() : g_buffer.by_positions(), camera, converged_vao(1), {target.name()});
    std::vector<float> values;
    for (const glm::vec4& texel : read_image(target.name(), kWidth, kHeight)) values.push_back(texel.x);
    return values;
  };
  for (const auto& group : {std::vector{usual, reversed, infinite}, std::vector{parallel, reversed_parallel}}) {
    const std::vector<float> first = draw(group[0], false);
    double sum = 0;
    for (const float value : first) sum += double{value};
    EXPECT_GT(sum, 20);
    for (const Camera& camera : group) {
      const std::vector<float> other = draw(camera, true);
      double off = 0;
      for (std::size_t i = 0; i < first.size(); ++i) off += std::fabs(double{first[i]} - double{other[i]});
      EXPECT_LT(off / static_cast<double>(first.size()), 1e-3);
    }
  }
}

TEST_F(Vao, AnyGBufferWillDo) {
  const Mesh mesh = furnished_room();
  const Camera camera = room_camera(kWidth, kHeight);
  const GBufferPass g_buffer(mesh, camera, kWidth, kHeight);
  const Texture target = make_image(GL_R32F, kWidth, kHeight);
  std::vector<std::vector<float>> all;
  for (const GBuffer& textures :
       {g_buffer.by_positions(), g_buffer.by_depth(), g_buffer.by_linear_depth(), g_buffer.by_view_positions()}) {
    pass_->draw(textures, camera, plain_set(0.5f, 32), {target.name()});
    all.emplace_back();
    for (const glm::vec4& texel : read_image(target.name(), kWidth, kHeight)) all.back().push_back(texel.x);
  }
  std::size_t off_count = 0;
  double sum = 0;
  for (std::size_t i = 0; i < all[0].size(); ++i) {
    sum += double{all[0][i]};
    for (const std::vector<float>& other : all) off_count += !(std::fabs(other[i] - all[0][i]) < 0.01f);
  }
  EXPECT_GT(sum, 20);
  EXPECT_LE(off_count, 6u);
}

TEST_F(Vao, WritesEverySize) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 1}, {17, 33}, {203, 77}}) {
    const PixelView view = random_view(straight_camera(), width, height, 2);
    for (const VaoCulling culling : {VaoCulling::off, VaoCulling::greedy, VaoCulling::careful}) {
      VaoOptions options{.radius = 1.5f, .sample_count = 8, .culling = culling};
      const std::vector<float> drawn = draw_vao(view, *pass_, options, 1, GL_R32F, 5);
      std::size_t wrong_count = 0;
      for (std::size_t i = 0; i < drawn.size(); ++i) {
        wrong_count += view.pixels()[i].is_there() ? !(drawn[i] >= 0 && drawn[i] <= 1) : drawn[i] != 5;
      }
      EXPECT_EQ(wrong_count, 0u) << width << 'x' << height;
    }
  }
}

TEST_F(Vao, TakesEveryNthPixelAndPartsOfTextures) {
  const PixelView view = random_view(straight_camera(), kWidth + 1, kHeight, 4);
  for (const int step : {2, 3}) {
    const Off off = this->off(
        view, plain_set(2, 16), [](int x, int y) { return VaoDefinition::set_of(x, y, 16); }, step);
    EXPECT_LE(off.far_count, 2u) << step;
    EXPECT_GT(off.mean_expected, 0.05);
  }
  const std::vector<float> whole = draw_vao(view, *pass_, plain_set(2, 16), 1, GL_R32F, -1);
  const Texture target = make_image(GL_RGBA16F, kWidth + 6, kHeight + 9);
  pass_->draw(view.g_buffer(), view.camera(), plain_set(2, 16),
              {target.name(), -1, Quantity::visibility, Channel::green, Part{3, 7}});
  const std::vector<glm::vec4> texels = read_image(target.name(), kWidth + 6, kHeight + 9);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x <= kWidth; ++x) {
      const glm::vec4& texel = texels[static_cast<std::size_t>((y + 7) * (kWidth + 6) + x + 3)];
      const float expected = whole[static_cast<std::size_t>(y * (kWidth + 1) + x)];
      EXPECT_NEAR(texel.y, expected < 0 ? -1 : 1 - expected, 1e-3f);
      EXPECT_EQ(texel.x, 0);
    }
  }
}

TEST_F(Vao, OfAnEmptySceneIsTheBackground) {
  const PixelView empty(straight_camera(), kWidth, kHeight, std::vector<SeenPixel>(std::size_t{kWidth} * kHeight));
  EXPECT_THAT(draw_vao(empty, *pass_, {.radius = 1}, 1, GL_R32F, 0.25f), Each(0.25f));
  // Pixels that are nowhere, with a normal.
  std::vector<SeenPixel> nowhere(empty.pixels().size());
  for (SeenPixel& pixel : nowhere) {
    pixel.position = glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    pixel.normal = pixel.geometric_normal = {0, 1, 0};
  }
  const PixelView lost(straight_camera(), kWidth, kHeight, nowhere);
  EXPECT_THAT(draw_vao(lost, *pass_, {.radius = 1}, 1, GL_R32F, 0.25f), Each(0.25f));
}

TEST_F(Vao, BallsEndBeforeTheEye) {
  // A floor so near that a ball of the radius would hold the eye: nothing of it is above itself.
  const PixelView view = view_of_ground([](double, double) { return -0.1; }, kWidth, kHeight);
  for (const float value : draw_vao(view, *pass_, converged_vao(50))) ASSERT_NEAR(value, 0, 1e-5);
}

TEST_F(Vao, NamesWhatIsWrong) {
  const PixelView view = random_view(straight_camera(), kWidth, kHeight, 4);
  const Texture target = make_image(GL_R32F, kWidth, kHeight), small = make_image(GL_R32F, kWidth, kHeight - 1);
  const Texture colours = make_image(GL_RGBA8, kWidth, kHeight), two = make_image(GL_RG8, kWidth, kHeight);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  struct Mistake {
    const char* name;
    std::function<void(VaoOptions&)> make;
  };
  const Mistake mistakes[] = {
      {"radius must be above 0", [](VaoOptions& o) { o.radius = 0; }},
      {"radius", [=](VaoOptions& o) { o.radius = nan; }},
      {"radius", [](VaoOptions& o) { o.radius = 1e19f; }},
      {"sample_count", [](VaoOptions& o) { o.sample_count = 1; }},
      {"sample_count", [](VaoOptions& o) { o.sample_count = 12; }},
      {"sample_count", [](VaoOptions& o) { o.sample_count = 65536; }},
      {"fewest_samples_width", [](VaoOptions& o) { o.fewest_samples_width = -1; }},
      {"fewest_samples_width", [=](VaoOptions& o) { o.fewest_samples_width = nan; }},
      {"thickness", [](VaoOptions& o) { o.thickness = -0.1f; }},
      {"bleeding_stride", [](VaoOptions& o) { o.bleeding_stride = 3; }},
      {"luminance threshold", [=](VaoOptions& o) { o.luminance = {.threshold = nan}; }},
      {"luminance width", [](VaoOptions& o) { o.luminance = {.width = 0}; }},
      {"luminance sigma", [](VaoOptions& o) { o.luminance = {.sigma = 0}; }},
      {"colours must be given for luminance", [](VaoOptions& o) { o.luminance = LuminanceSensitivity{}; }}};
  const VaoOptions right{.radius = 1};
  const auto expect_named = [&](const char* named, const VaoOptions& options, const GBuffer& g_buffer,
                                const Texture& to, const BleedingTarget* bleeding = nullptr) {
    expect_error<std::invalid_argument>(named,
                                        [&] { pass_->draw(g_buffer, view.camera(), options, {to.name()}, bleeding); });
  };
  for (const Mistake& mistake : mistakes) {
    VaoOptions options = right;
    mistake.make(options);
    expect_named(mistake.name, options, view.g_buffer(), target);
  }
  expect_named("occlusion must be of", right, view.g_buffer(), small);
  GBuffer g_buffer = view.g_buffer();
  BleedingTarget bleeding{.texture = colours.name()};
  expect_named("colours must be given for bleeding", right, g_buffer, target, &bleeding);
  g_buffer.colours = two.name();
  expect_named("colours must have 3", right, g_buffer, target);
  g_buffer.colours = colours.name();
  bleeding.texture = small.name();
  expect_named("bleeding must be of 40x30", right, g_buffer, target, &bleeding);
  bleeding.texture = two.name();
  expect_named("bleeding must have one of the formats", right, g_buffer, target, &bleeding);
  EXPECT_THROW((void)pass_->read_counts(), std::runtime_error) << "nothing is counted";
  EXPECT_THROW((void)VaoPass({.count = true}).read_counts(), std::runtime_error) << "not drawn";
}

TEST_F(Vao, IsDrawnWithoutExceptions) {
  const PixelView view = random_view(straight_camera(), kWidth, kHeight, 4);
  Status status;
  std::optional<VaoPass> pass = VaoPass::try_make({.host_errors = HostErrors::dropped}, status);
  ASSERT_TRUE(pass && status) << status.message;
  const Texture target = make_image(GL_R32F, kWidth, kHeight);
  glEnable(GL_TEXTURE_2D_ARRAY);  // an error that is dropped
  EXPECT_TRUE(pass->try_draw(view.g_buffer(), view.camera(), {.radius = 1}, {target.name()}));
  EXPECT_THAT(pass->try_draw(view.g_buffer(), view.camera(), {}, {target.name()}).message, HasSubstr("radius"));
  context_->release();
  EXPECT_FALSE(VaoPass::try_make({}, status));
  EXPECT_THAT(status.message, HasSubstr("no OpenGL context"));
  EXPECT_TRUE(context_->try_make_current());
}

}  // namespace
}  // namespace lkao::gl::tests::vao_pass_test
