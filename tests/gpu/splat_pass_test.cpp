// The splat pass as a whole: both halves, all sizes, its mistakes.
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

#include "gpu/on_software.h"
#include "gpu/pass_scene.h"
#include "gpu/splat_scene.h"
#include "support/sanitized.h"

namespace lkao::gl::tests::splat_pass_test {
namespace {

using testing::Each;
using testing::HasSubstr;

constexpr int kWidth = 40;
constexpr int kHeight = 30;
constexpr SplatOptions kBoth{.near_radius = 0.6f, .samples_per_pixel = 1e6f, .max_sample_count = 16384};

class Splats : public OnSoftware {
 protected:
  void SetUp() override {
    OnSoftware::SetUp();
    if (IsSkipped()) return;
    pass_ = std::make_unique<SplatPass>();
    camera_ = room_camera(kWidth, kHeight);
    view_ = std::make_unique<PixelView>(random_view(camera_, kWidth, kHeight, 12));
    lut::RandomStream random(13);
    for (int i = 0; i < 40; ++i) {
      spheres_.emplace_back(lkao::tests::random_point(random, 3), 0.05f + 0.4f * lkao::tests::uniform(random, 0, 1));
    }
    pass_->set_spheres(spheres_);
  }
  void TearDown() override {
    view_.reset();
    pass_.reset();
  }

  Camera camera_;
  std::unique_ptr<PixelView> view_;
  std::vector<glm::vec4> spheres_;
  std::unique_ptr<SplatPass> pass_;
};

TEST_F(Splats, AddBothHalvesUpAndDivideSpheresBetweenThem) {
  for (const float far_radius : {std::numeric_limits<float>::infinity(), 2.0f}) {
    SplatOptions options = kBoth;
    options.far_radius = far_radius;
    const std::vector<float> drawn = draw_splats(*view_, *pass_, options);
    std::size_t both_count = 0, wrong_count = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const SeenPixel& pixel = view_->pixels()[i];
      if (!pixel.is_there()) continue;
      const double near = expected_near(*view_, i, {view_.get()}, options);
      const double far = expected_far(pixel, spheres_, options);
      both_count += near > 0 && far > 0;
      wrong_count += !(std::fabs(drawn[i] - std::fmin(near + far, 1.0)) < 3e-4);
    }
    EXPECT_GT(both_count, 50u);
    EXPECT_LE(wrong_count, 3u);  // at the ends of spheres rounding decides
  }
}

// A sphere moves away from a receiver: what it blocks must not jump where the far half takes it over, nor where it
// leaves the receiver.
TEST_F(Splats, NothingJumpsWhereTheFarHalfBegins) {
  const glm::dvec3 up(0, 0, 1);
  const Camera camera{glm::mat4(1), glm::perspective(1.0f, 1.0f, 0.1f, 10.0f)};
  const PixelView view(camera, 1, 1, {{{0, 0, -2}, up, up}});
  SplatOptions options = kBoth;
  for (const float near_radius : {0.5f, 0.01f}) {
    options.near_radius = near_radius;
    std::vector<float> drawn;
    for (int i = 0; i < 100; ++i) {
      pass_->set_spheres(std::vector<glm::vec4>{{0, 0, -1.99f + 0.01f * static_cast<float>(i), 0.2f}});
      drawn.push_back(draw_splats(view, *pass_, options)[0]);
    }
    const std::size_t begin = near_radius > 0.4f ? 28 : 18;  // where its far side is so far; where it has left
    EXPECT_EQ(drawn[begin], 0);
    EXPECT_GT(drawn[begin + 12], 0.05f);
    for (std::size_t i = 1; i < drawn.size(); ++i) EXPECT_NEAR(drawn[i], drawn[i - 1], 0.04);
  }
}

TEST_F(Splats, WriteEverySize) {
  for (const auto& [width, height] :
       {std::pair{1, 1}, {3, 1}, {17, 33}, lkao::tests::unless_sanitized(std::pair{511, 383}, {127, 95})}) {
    const Camera camera = room_camera(width, height);
    const PixelView view = random_view(camera, width, height, 2);
    SplatOptions options{.near_radius = 0.2f, .max_sample_count = 2};
    const std::vector<float> drawn = draw_splats(view, *pass_, options, &view, GL_R32F, 0.5f);
    std::size_t wrong_count = 0, blocked_count = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      wrong_count += view.pixels()[i].is_there() ? !(drawn[i] >= 0 && drawn[i] <= 1) : drawn[i] != 0.5f;
      blocked_count += view.pixels()[i].is_there() && drawn[i] > 0;
    }
    EXPECT_EQ(wrong_count, 0u) << width << 'x' << height;
    EXPECT_TRUE(blocked_count > drawn.size() / 10 || drawn.size() < 100u) << width << 'x' << height;
  }
}

TEST_F(Splats, TakeEveryNthPixelAndPartsOfTextures) {
  // What spheres of the scene block of a receiver is the same however many pixels there are.
  const SplatOptions far_half{.near_half = false};
  const std::vector<float> whole = draw_splats(*view_, *pass_, far_half, nullptr, GL_R32F, -1);
  for (const int step : {1, 2, 5}) {
    GBuffer textures = view_->g_buffer();
    textures.step = step;
    const int width = textures.picture_width(), height = textures.picture_height();
    const Texture target = make_image(GL_RGBA16F, width + 5, height + 9);
    pass_->draw(textures, camera_, far_half, {target.name(), -1, Quantity::visibility, Channel::green, Part{3, 7}});
    const std::vector<glm::vec4> texels = read_image(target.name(), width + 5, height + 9);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const glm::vec4& texel = texels[static_cast<std::size_t>((y + 7) * (width + 5) + x + 3)];
        const float expected = whole[static_cast<std::size_t>(step * y * kWidth + step * x)];
        EXPECT_NEAR(texel.y, expected < 0 ? -1 : 1 - expected, 1e-3f) << x << ", " << y << ", step " << step;
        EXPECT_EQ(texel.x, 0);
      }
    }
  }
}

TEST_F(Splats, WriteEveryFormat) {
  const std::vector<float> exact = draw_splats(*view_, *pass_, kBoth);
  for (const int format : {GL_R8, GL_R16, GL_R16F}) {
    const std::vector<float> drawn = draw_splats(*view_, *pass_, kBoth, nullptr, static_cast<GLenum>(format));
    for (std::size_t i = 0; i < drawn.size(); ++i) ASSERT_NEAR(drawn[i], exact[i], 0.6 / 255);
  }
}

TEST_F(Splats, OfAnEmptySceneAreTheBackground) {
  const PixelView empty(camera_, kWidth, kHeight, std::vector<SeenPixel>(view_->pixels().size()));
  EXPECT_THAT(draw_splats(empty, *pass_, kBoth, nullptr, GL_R32F, 0.25f), Each(0.25f));
  // Pixels that are nowhere, with a normal.
  std::vector<SeenPixel> nowhere(view_->pixels().size());
  for (SeenPixel& pixel : nowhere) {
    pixel.position = glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    pixel.normal = pixel.geometric_normal = {0, 1, 0};
  }
  const PixelView lost(camera_, kWidth, kHeight, nowhere);
  EXPECT_THAT(draw_splats(lost, *pass_, kBoth, nullptr, GL_R32F, 0.25f), Each(0.25f));
  // Nor do such pixels of a second layer block.
  EXPECT_EQ(draw_splats(*view_, *pass_, kBoth, &lost), draw_splats(*view_, *pass_, kBoth));
}

TEST_F(Splats, WithoutSpheresAreTheNearHalfAlone) {
  SplatOptions near = kBoth;
  near.far_half = false;
  const std::vector<float> expected = draw_splats(*view_, *pass_, near);
  pass_->set_spheres({});
  EXPECT_EQ(draw_splats(*view_, *pass_, kBoth), expected);
  SplatOptions none = kBoth;
  none.near_half = none.far_half = false;
  EXPECT_THAT(draw_splats(*view_, *pass_, none), Each(0.0f));
}

TEST_F(Splats, NameWhatIsWrong) {
  const Texture target = make_image(GL_R32F, kWidth, kHeight), small = make_image(GL_R32F, kWidth, kHeight - 1);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  struct Mistake {
    const char* name;
    std::function<void(SplatOptions&)> make;
  };
  const Mistake mistakes[] = {{"near_radius", [](SplatOptions& o) { o.near_radius = 0; }},
                              {"near_radius", [=](SplatOptions& o) { o.near_radius = nan; }},
                              {"near_radius", [](SplatOptions& o) { o.near_radius = 1e19f; }},
                              {"samples_per_pixel", [](SplatOptions& o) { o.samples_per_pixel = -1; }},
                              {"max_sample_count", [](SplatOptions& o) { o.max_sample_count = 0; }},
                              {"max_sample_count", [](SplatOptions& o) { o.max_sample_count = 16385; }},
                              {"pixel_sphere_radius", [](SplatOptions& o) { o.pixel_sphere_radius = 0; }},
                              {"pixel_sphere_radius", [](SplatOptions& o) { o.pixel_sphere_radius = 17; }},
                              {"epsilon", [](SplatOptions& o) { o.epsilon = 0; }},
                              {"epsilon", [](SplatOptions& o) { o.epsilon = 2; }},
                              {"far_radius", [=](SplatOptions& o) { o.far_radius = nan; }},
                              {"far_radius", [](SplatOptions& o) { o.far_radius = 0; }}};
  const auto message = [&](const SplatOptions& options, GLuint texture, const GBuffer* behind = nullptr) {
    try {
      pass_->draw(view_->g_buffer(), camera_, options, {texture}, behind);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("no exception");
  };
  for (const Mistake& mistake : mistakes) {
    SplatOptions options = kBoth;
    mistake.make(options);
    EXPECT_THAT(message(options, target.name()), HasSubstr(mistake.name));
  }
  EXPECT_THAT(message(kBoth, small.name()), HasSubstr("occlusion must be of"));
  GBuffer behind = view_->g_buffer();
  behind.width -= 1;
  EXPECT_THAT(message(kBoth, target.name(), &behind), HasSubstr("behind must be of 40x30 pixels"));
  behind = view_->g_buffer();
  behind.normals = 0;
  EXPECT_THAT(message(kBoth, target.name(), &behind), HasSubstr("normals is not set"));
  // What a half needs is no concern where it is off.
  SplatOptions far = {.near_half = false};
  EXPECT_EQ(message(far, target.name()), "no exception");
  SplatOptions near = kBoth;
  near.far_half = false;
  near.epsilon = near.far_radius = 0;
  EXPECT_EQ(message(near, target.name()), "no exception");
  EXPECT_THROW((void)pass_->read_fragment_count(), std::runtime_error) << "nothing is counted";
  EXPECT_THROW((void)SplatPass({.count_fragments = true}).read_fragment_count(), std::runtime_error) << "not drawn";
}

TEST_F(Splats, AreDrawnWithoutExceptions) {
  Status status;
  std::optional<SplatPass> pass = SplatPass::try_make({.host_errors = HostErrors::dropped}, status);
  ASSERT_TRUE(pass && status) << status.message;
  const Texture target = make_image(GL_R32F, kWidth, kHeight);
  glEnable(GL_TEXTURE_2D_ARRAY);  // an error that is dropped
  EXPECT_TRUE(pass->try_set_spheres(spheres_));
  EXPECT_TRUE(pass->try_draw(view_->g_buffer(), camera_, kBoth, {target.name()}));
  EXPECT_THAT(pass->try_draw(view_->g_buffer(), camera_, {}, {target.name()}).message, HasSubstr("near_radius"));
  glEnable(GL_TEXTURE_2D_ARRAY);
  EXPECT_THAT(pass_->try_set_spheres(spheres_).message, HasSubstr("before lkao was called"));
  context_->release();
  EXPECT_FALSE(SplatPass::try_make({}, status));
  EXPECT_THAT(status.message, HasSubstr("no OpenGL context"));
  EXPECT_TRUE(context_->try_make_current());
}

}  // namespace
}  // namespace lkao::gl::tests::splat_pass_test
