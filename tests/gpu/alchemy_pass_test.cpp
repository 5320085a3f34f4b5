// The Alchemy pass as a whole: all cameras, sizes and targets, its mistakes.
#include <gmock/gmock.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "gpu/alchemy_definition.h"
#include "gpu/expect_error.h"
#include "gpu/on_software.h"
#include "gpu/pass_scene.h"
#include "support/sanitized.h"

namespace lkao::gl::tests::alchemy_pass_test {
namespace {

using testing::Each;
using testing::HasSubstr;

constexpr int kSide = lkao::tests::kIsSanitized ? 24 : 36;
constexpr AlchemyOptions kFew{.radius = 1, .samples_per_band = 3};
// So many that two of them differ by what pixels are off, not by noise.
constexpr AlchemyOptions kMany{.radius = 1.5f, .intensity = 0.8f, .samples_per_band = 8192, .max_band_count = 1};

Camera square_camera() { return room_camera(kSide, kSide); }

double rms_difference(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (double{a[i]} - b[i]) * (double{a[i]} - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

double mean_of(const std::vector<float>& values) {
  double sum = 0;
  for (const float value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

class Alchemy : public OnSoftware {
 protected:
  void SetUp() override {
    OnSoftware::SetUp();
    if (IsSkipped()) return;
    pass_ = std::make_unique<AlchemyPass>();
    view_ = std::make_unique<PixelView>(random_view(square_camera(), kSide, kSide, 12));
  }
  void TearDown() override {
    view_.reset();
    pass_.reset();
  }

  std::vector<float> draw(const PixelView& view, const AlchemyOptions& options, GLenum format = GL_R32F,
                          float background = 0) {
    return view.draw([&](const OcclusionTarget& to) { pass_->draw(view.g_buffer(), view.camera(), options, to); }, 1,
                     format, background);
  }

  std::vector<float> draw(const GBuffer& g_buffer, const Camera& camera, const AlchemyOptions& options) {
    const Texture target = make_image(GL_R32F, g_buffer.width, g_buffer.height);
    pass_->draw(g_buffer, camera, options, {target.name()});
    std::vector<float> occlusion;
    for (const glm::vec4& texel : read_image(target.name(), g_buffer.width, g_buffer.height)) {
      occlusion.push_back(texel.x);
    }
    return occlusion;
  }

  std::unique_ptr<AlchemyPass> pass_;
  std::unique_ptr<PixelView> view_;
};

TEST_F(Alchemy, OfATurnedOrMirroredCameraIsTurnedOrMirrored) {
  const std::vector<float> usual = draw(*view_, kMany);
  EXPECT_GT(mean_of(usual), 0.05);
  const auto index = [](int x, int y) { return static_cast<std::size_t>(y * kSide + x); };
  using Place = std::function<std::size_t(int, int)>;
  // A quarter turn takes x to y, and y to -x.
  Camera turned = square_camera();
  turned.view = glm::rotate(glm::mat4(1), glm::radians(90.0f), glm::vec3(0, 0, 1)) * turned.view;
  Camera mirrored = square_camera();
  mirrored.projection[0] = -mirrored.projection[0];
  const std::pair<Camera, Place> all[] = {{turned, [&](int x, int y) { return index(kSide - 1 - y, x); }},
                                          {mirrored, [&](int x, int y) { return index(kSide - 1 - x, y); }}};
  for (const auto& [camera, place] : all) {
    std::vector<SeenPixel> pixels(usual.size());
    std::vector<float> expected(usual.size());
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        pixels[place(x, y)] = view_->pixels()[index(x, y)];
        expected[place(x, y)] = usual[index(x, y)];
      }
    }
    EXPECT_LT(rms_difference(draw({camera, kSide, kSide, pixels}, kMany), expected), 3e-3);
    EXPECT_GT(rms_difference(usual, expected), 0.05);
  }
}

TEST_F(Alchemy, DoesNotDependOnTheUnit) {
  std::vector<SeenPixel> pixels = view_->pixels();
  const Camera camera{glm::mat4(1), square_camera().projection};
  for (SeenPixel& pixel : pixels) {
    pixel.position = glm::dvec3(glm::dmat4(square_camera().view) * glm::dvec4(pixel.position, 1));
  }
  const std::vector<float> usual = draw({camera, kSide, kSide, pixels}, kFew);
  EXPECT_GT(mean_of(usual), 0.05);
  for (const double scale : {1e-3, 1e4}) {
    std::vector<SeenPixel> scaled = pixels;
    for (SeenPixel& pixel : scaled) pixel.position *= scale;
    AlchemyOptions options = kFew;
    options.radius = static_cast<float>(scale);
    EXPECT_LT(rms_difference(draw({camera, kSide, kSide, scaled}, options), usual), 1e-3);
  }
}

// Standard, reversed and infinite depths, distances and positions, of one mesh.
TEST_F(Alchemy, AnyGBufferWillDo) {
  const Mesh mesh = furnished_room();
  const Camera standard = square_camera();
  Camera reversed = standard, endless = standard;
  reversed.clip_depth = endless.clip_depth = ClipDepth::zero_to_one;
  reversed.projection[2][2] = 0.05f / (50 - 0.05f);
  reversed.projection[3][2] = 50 * 0.05f / (50 - 0.05f);
  endless.projection[2][2] = 0;
  endless.projection[3][2] = 0.05f;
  const GBufferPass usual(mesh, standard, kSide, kSide), other(mesh, reversed, kSide, kSide),
      third(mesh, endless, kSide, kSide);
  const std::vector<float> expected = draw(usual.by_positions(), standard, kFew);
  EXPECT_GT(mean_of(expected), 0.05);
  const std::pair<GBuffer, Camera> all[] = {{usual.by_depth(), standard},          {usual.by_linear_depth(), standard},
                                            {usual.by_view_positions(), standard}, {other.by_depth(), reversed},
                                            {other.by_linear_depth(), reversed},   {third.by_depth(), endless}};
  for (const auto& [g_buffer, camera] : all) {
    EXPECT_LT(rms_difference(draw(g_buffer, camera, kFew), expected), 0.01);
  }
}

// A camera without perspective sees what one does that is far away.
TEST_F(Alchemy, OfAParallelCameraIsThatOfADistantOne) {
  const Mesh mesh = furnished_room();
  const glm::vec3 target(0, 1.8f, -1), from = glm::normalize(glm::vec3(0.2f, 0.4f, 1));
  Camera parallel{glm::lookAt(target + 20.0f * from, target, glm::vec3(0, 1, 0)),
                  glm::ortho(-2.0f, 2.0f, -2.0f, 2.0f, 0.1f, 40.0f)};
  constexpr float kFar = 2000;
  const Camera distant{glm::lookAt(target + kFar * from, target, glm::vec3(0, 1, 0)),
                       glm::perspective(2 * std::atan(2 / kFar), 1.0f, kFar - 20, kFar + 20)};
  const PixelView near_view = view_of_mesh(mesh, parallel, kSide, kSide);
  const PixelView far_view = view_of_mesh(mesh, distant, kSide, kSide);
  AlchemyOptions options = kMany;
  options.bias = 0.002f;  // a share of half of what a side sees
  const std::vector<float> expected = draw(near_view, options);
  EXPECT_GT(mean_of(expected), 0.03);
  options.bias = 0.002f * 2 / kFar;
  EXPECT_LT(rms_difference(draw(far_view, options), expected), 0.02);
}

TEST_F(Alchemy, ShadingNormalsDoNotDarkenWhatIsFlat) {
  const PixelView flat = view_of_ground([](double, double) { return -1.2; }, 40, 30);
  std::vector<SeenPixel> pixels = flat.pixels();
  for (SeenPixel& pixel : pixels) {
    if (pixel.is_there()) pixel.normal = glm::normalize(glm::dvec3(0.3, 1, -0.2));
  }
  const PixelView shaded(flat.camera(), 40, 30, pixels);
  EXPECT_THAT(draw(shaded, kFew), Each(0.0f));
  // Without the surface's own normals it would.
  GBuffer textures = shaded.g_buffer();
  textures.geometric_normals = 0;
  EXPECT_GT(mean_of(draw(textures, shaded.camera(), kFew)), 0.01);
}

TEST_F(Alchemy, WritesEverySize) {
  for (const auto& [width, height] :
       {std::pair{1, 1}, {3, 1}, {17, 33}, lkao::tests::unless_sanitized(std::pair{401, 299}, {127, 95})}) {
    const PixelView view = random_view(room_camera(width, height), width, height, 2);
    const std::vector<float> drawn = draw(view, kFew, GL_R32F, 0.5f);
    std::size_t wrong_count = 0, dark_count = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      wrong_count += view.pixels()[i].is_there() ? !(drawn[i] >= 0 && drawn[i] <= 1) : drawn[i] != 0.5f;
      dark_count += view.pixels()[i].is_there() && drawn[i] > 0;
    }
    EXPECT_EQ(wrong_count, 0u) << width << 'x' << height;
    EXPECT_TRUE(dark_count > drawn.size() / 10 || drawn.size() < 100u) << width << 'x' << height;
  }
}

TEST_F(Alchemy, WritesPartsAndChannels) {
  const std::vector<float> whole = draw(*view_, kFew, GL_R32F, -1);
  const Texture target = make_image(GL_RGBA16F, kSide + 5, kSide + 9);
  pass_->draw(view_->g_buffer(), view_->camera(), kFew,
              {target.name(), -1, Quantity::visibility, Channel::green, Part{3, 7}});
  const std::vector<glm::vec4> texels = read_image(target.name(), kSide + 5, kSide + 9);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const glm::vec4& texel = texels[static_cast<std::size_t>((y + 7) * (kSide + 5) + x + 3)];
      const float expected = whole[static_cast<std::size_t>(y * kSide + x)];
      EXPECT_NEAR(texel.y, expected < 0 ? -1 : 1 - expected, 1e-3f) << x << ", " << y;
      EXPECT_EQ(texel.x, 0);
    }
  }
}

TEST_F(Alchemy, OfPixelsThatAreNowhereIsTheBackground) {
  std::vector<SeenPixel> nowhere(view_->pixels().size());
  for (SeenPixel& pixel : nowhere) {
    pixel.position = glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    pixel.normal = pixel.geometric_normal = {0, 1, 0};
  }
  EXPECT_THAT(draw({square_camera(), kSide, kSide, nowhere}, kFew, GL_R32F, 0.25f), Each(0.25f));
  EXPECT_THAT(draw({square_camera(), kSide, kSide, std::vector<SeenPixel>(nowhere.size())}, kFew, GL_R32F, 0.25f),
              Each(0.25f));
}

// Behind the eye, in it, and at the end of what is usable, with radii of all sizes.
TEST_F(Alchemy, WritesNumbersWhereverPixelsAre) {
  std::vector<SeenPixel> pixels = view_->pixels();
  const glm::dvec3 eye(glm::inverse(square_camera().view)[3]);
  const double places[] = {0, -1, 1e-30, 1e10, 9e17, -9e17};
  for (std::size_t i = 0; i < pixels.size(); i += 3) {
    if (pixels[i].is_there()) pixels[i].position = eye + places[i / 3 % 6] * (pixels[i].position - eye) * 0.1;
  }
  for (const float radius : {1e-18f, 1.0f, 1e18f}) {
    AlchemyOptions options = kFew;
    options.radius = radius;
    options.epsilon = 1e-12f;
    options.intensity = 1e18f;
    for (const float value : draw({square_camera(), kSide, kSide, pixels}, options)) {
      ASSERT_TRUE(value >= 0 && value <= 1) << value;
    }
  }
}

TEST_F(Alchemy, NamesWhatIsWrong) {
  const Texture target = make_image(GL_R32F, kSide, kSide), small = make_image(GL_R32F, kSide, kSide - 1);
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  struct Mistake {
    const char* name;
    std::function<void(AlchemyOptions&)> make;
  };
  const Mistake mistakes[] = {{"radius", [](AlchemyOptions& o) { o.radius = 0; }},
                              {"radius", [=](AlchemyOptions& o) { o.radius = nan; }},
                              {"radius", [=](AlchemyOptions& o) { o.radius = infinity; }},
                              {"intensity", [](AlchemyOptions& o) { o.intensity = -1; }},
                              {"intensity", [=](AlchemyOptions& o) { o.intensity = infinity; }},
                              {"bias", [](AlchemyOptions& o) { o.bias = -1; }},
                              {"bias", [=](AlchemyOptions& o) { o.bias = nan; }},
                              {"epsilon", [](AlchemyOptions& o) { o.epsilon = 0; }},
                              {"epsilon", [=](AlchemyOptions& o) { o.epsilon = infinity; }},
                              {"contrast", [](AlchemyOptions& o) { o.contrast = 0; }},
                              {"contrast", [=](AlchemyOptions& o) { o.contrast = infinity; }},
                              {"samples_per_band", [](AlchemyOptions& o) { o.samples_per_band = 0; }},
                              {"samples_per_band", [](AlchemyOptions& o) { o.samples_per_band = 16384 / 3 + 1; }},
                              {"max_band_count", [](AlchemyOptions& o) { o.max_band_count = 0; }},
                              {"max_band_count", [](AlchemyOptions& o) { o.max_band_count = 17; }},
                              {"full_radius", [](AlchemyOptions& o) { o.full_radius = -1; }},
                              {"full_radius", [=](AlchemyOptions& o) { o.full_radius = nan; }},
                              {"spiral_turns", [](AlchemyOptions& o) { o.spiral_turns = 0; }},
                              {"spiral_turns", [=](AlchemyOptions& o) { o.spiral_turns = infinity; }}};
  for (const Mistake& mistake : mistakes) {
    AlchemyOptions options = kFew;
    mistake.make(options);
    expect_error<std::invalid_argument>(
        mistake.name, [&] { pass_->draw(view_->g_buffer(), view_->camera(), options, {target.name()}); });
  }
  expect_error<std::invalid_argument>("occlusion must be of",
                                      [&] { pass_->draw(view_->g_buffer(), view_->camera(), kFew, {small.name()}); });
  GBuffer without = view_->g_buffer();
  without.normals = 0;
  expect_error<std::invalid_argument>("normals is not set",
                                      [&] { pass_->draw(without, view_->camera(), kFew, {target.name()}); });
  expect_error<std::invalid_argument>("camera.projection", [&] {
    pass_->draw(view_->g_buffer(), {view_->camera().view, glm::mat4(0)}, kFew, {target.name()});
  });
}

TEST_F(Alchemy, IsDrawnWithoutExceptions) {
  Status status;
  std::optional<AlchemyPass> pass = AlchemyPass::try_make({.host_errors = HostErrors::dropped}, status);
  ASSERT_TRUE(pass && status) << status.message;
  const Texture target = make_image(GL_R32F, kSide, kSide);
  glEnable(GL_TEXTURE_2D_ARRAY);  // an error that is dropped
  EXPECT_TRUE(pass->try_draw(view_->g_buffer(), view_->camera(), kFew, {target.name()}));
  EXPECT_THAT(pass->try_draw(view_->g_buffer(), view_->camera(), {}, {target.name()}).message, HasSubstr("radius"));
  glEnable(GL_TEXTURE_2D_ARRAY);
  EXPECT_THAT(pass_->try_draw(view_->g_buffer(), view_->camera(), kFew, {target.name()}).message,
              HasSubstr("before lkao was called"));
  context_->release();
  EXPECT_FALSE(AlchemyPass::try_make({}, status));
  EXPECT_THAT(status.message, HasSubstr("no OpenGL context"));
  EXPECT_TRUE(context_->try_make_current());
}

}  // namespace
}  // namespace lkao::gl::tests::alchemy_pass_test
