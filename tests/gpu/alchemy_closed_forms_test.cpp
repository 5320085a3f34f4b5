// Alchemy's obscurance of shapes whose integral over the disc is known: planes, pits, walls, corners, grooves, as
// cameras without perspective see them.
#include <gmock/gmock.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "gpu/alchemy_definition.h"
#include "gpu/on_software.h"
#include "support/meshes.h"

namespace lkao::gl::tests::alchemy_closed_forms_test {
namespace {

using lkao::tests::add_quad;
using testing::Each;

constexpr double kPi = std::numbers::pi;
constexpr int kWidth = 96;
constexpr int kHeight = 72;
constexpr double kPixel = 0.025;  // how wide, of cameras without perspective
constexpr int kMargin = 25;       // pixels at the edges whose disc ends beyond them

// The radius is 24 pixels.
constexpr AlchemyOptions kOptions{
    .radius = 0.6f, .intensity = 0.4f, .bias = 1e-6f, .samples_per_band = 4096, .max_band_count = 1};

// Looks at a point from a direction.
Camera parallel_camera(const glm::dvec3& from, const glm::dvec3& target, const glm::dvec3& up = {0, 1, 0}) {
  const auto x = static_cast<float>(0.5 * kPixel * kWidth), y = static_cast<float>(0.5 * kPixel * kHeight);
  return {glm::lookAt(glm::vec3(target + 5.0 * from), glm::vec3(target), glm::vec3(up)),
          glm::ortho(-x, x, -y, y, 0.1f, 10.0f)};
}

// Of an endless wall at a distance, in radii, above its foot: the integral over the wall of its height over the
// floor, divided by the squared distance and epsilon; what faces the camera takes more of the disc.
double mean_of_wall(double distance, double cosine) {
  const double end = std::sqrt(1 - distance * distance);
  const double least = std::sqrt(distance * distance + double{kOptions.epsilon});
  return cosine / kPi * 2 * (end - least * std::atan(end / least));
}

class AlchemyOfShapes : public OnSoftware {
 protected:
  void SetUp() override {
    OnSoftware::SetUp();
    if (IsSkipped()) return;
    pass_ = std::make_unique<AlchemyPass>();
  }
  void TearDown() override { pass_.reset(); }

  std::vector<float> draw(const PixelView& view, const AlchemyOptions& options = kOptions) {
    return view.draw([&](const OcclusionTarget& to) { pass_->draw(view.g_buffer(), view.camera(), options, to); });
  }

  // At pixels away from the edges. `expected`: the mean over the disc, below 0 where it is not known.
  void expect_means(const PixelView& view, const std::function<double(const SeenPixel&)>& expected, double tolerance,
                    int stride = 1) {
    const std::vector<float> drawn = draw(view);
    std::size_t count = 0;
    double worst = 0;
    for (int y = kMargin; y < kHeight - kMargin; y += stride) {
      for (int x = kMargin; x < kWidth - kMargin; x += stride) {
        const auto i = static_cast<std::size_t>(y * kWidth + x);
        const double mean = expected(view.pixels()[i]);
        if (mean < 0) continue;
        const double occlusion = expected_occlusion(mean, kOptions);
        worst = std::fmax(worst, std::fabs(drawn[i] - occlusion));
        EXPECT_NEAR(drawn[i], occlusion, tolerance) << x << ", " << y;
        count += occlusion > 0.05;
      }
    }
    RecordProperty("worst", std::to_string(worst));
    EXPECT_GT(count, 20u);
  }

  std::unique_ptr<AlchemyPass> pass_;
};

TEST_F(AlchemyOfShapes, PlanesStayOpenAtAnyAngle) {
  const Camera perspective = straight_camera();
  Camera parallel = perspective;
  parallel.projection = glm::ortho(-4.0f, 4.0f, -3.0f, 3.0f, 0.1f, 20.0f);
  for (const Camera& camera : {perspective, parallel}) {
    for (const glm::vec3 normal : {glm::vec3(0, 0, 1), {0.3f, 1, 0.2f}, {-3, 0.1f, 1}, {0, 20, 1}, {0.5f, -2, 0.3f}}) {
      const glm::vec3 side = 20.0f * glm::normalize(glm::cross(normal, glm::vec3(0.1f, 0.2f, 1)));
      const glm::vec3 other = glm::cross(glm::normalize(normal), side);
      Mesh mesh;
      add_quad(mesh, glm::vec3(0, 0, -2) - 0.5f * (side + other), side, other);
      AlchemyOptions options;
      options.radius = 1;
      options.samples_per_band = 64;
      EXPECT_THAT(draw(view_of_mesh(mesh, camera, kWidth, kHeight), options), Each(0.0f));
      // As a renderer has it: depths of 24 bits.
      const GBufferPass g_buffer(mesh, camera, kWidth, kHeight, {.depth = GL_DEPTH_COMPONENT24});
      const Texture target = make_image(GL_R32F, kWidth, kHeight);
      pass_->draw(g_buffer.by_depth(), camera, options, {target.name()});
      std::size_t dark_count = 0;
      for (const glm::vec4& texel : read_image(target.name(), kWidth, kHeight)) dark_count += texel.x > 0;
      EXPECT_EQ(dark_count, 0u) << normal.x << ' ' << normal.y << ' ' << normal.z;
    }
  }
}

// A round pit with a flat floor: the mean in its middle is h ln((1 + epsilon) / (a^2 + h^2 + epsilon)), with its radius
// a and its depth h.
TEST_F(AlchemyOfShapes, MiddleOfAPit) {
  constexpr int kSide = 81, kMiddle = 40 * kSide + 40;
  const float half = 0.5f * kSide;
  const Camera camera{glm::mat4(1), glm::ortho(-half, half, -half, half, 0.1f, 100.0f)};
  for (const double a : {0.2, 0.5}) {
    for (const double h : {0.1, 0.4}) {
      std::vector<SeenPixel> pixels(std::size_t{kSide} * kSide);
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
          const double from_middle = std::hypot(x - 40, y - 40);
          const glm::dvec3 position(x - 40, y - 40, -60 + (from_middle > 39 * a ? 39 * h : 0));
          pixels[static_cast<std::size_t>(y * kSide + x)] = {position, {0, 0, 1}, {0, 0, 1}};
        }
      }
      AlchemyOptions options = kOptions;
      options.radius = 39;
      options.samples_per_band = 1024;
      const double mean = h * std::log((1 + options.epsilon) / (a * a + h * h + options.epsilon));
      EXPECT_NEAR(draw({camera, kSide, kSide, pixels}, options)[kMiddle], expected_occlusion(mean, options), 0.01);
    }
  }
}

// From the foot on, for cameras that see wall and floor at several angles: the wall obscures the floor, and the floor
// the wall. Occlusion by rays is 1/2 at the foot whatever the camera.
TEST_F(AlchemyOfShapes, LongWall) {
  Mesh mesh;
  add_quad(mesh, {-4, 0, 0}, {8, 0, 0}, {0, 0, 4});
  add_quad(mesh, {-4, 0, 0}, {8, 0, 0}, {0, 4, 0});
  for (const double pitch : {0.4, 0.8, 1.2}) {
    SCOPED_TRACE(pitch);
    const glm::dvec3 from(0, std::sin(pitch), std::cos(pitch));
    const PixelView view = view_of_mesh(mesh, parallel_camera(from, {0, 0, 0}), kWidth, kHeight);
    const auto expected = [&](const SeenPixel& pixel) {
      const bool is_floor = pixel.normal.y > 0.5;
      const double distance = (is_floor ? pixel.position.z : pixel.position.y) / kOptions.radius;
      if (distance > 1) return 0.0;
      // Pixels are too large for what is nearer than two of them.
      if (distance * kOptions.radius < 2 * kPixel) return -1.0;
      return mean_of_wall(distance, is_floor ? from.z : from.y);
    };
    expect_means(view, expected, 0.008);
  }
}

// The rectangles of the definition are what the closed form says, at the foot too, and in the corner of a box, where
// the integral over each of two walls is half of an endless one's.
TEST_F(AlchemyOfShapes, RectanglesAreTheirClosedForms) {
  const glm::dvec3 up(0, 1, 0), towards = glm::normalize(glm::dvec3(0, 1, 2));
  for (const double distance : {0.0, 0.1, 0.5, 0.9}) {
    const AlchemyReceiver receiver{{0, 0, distance * kOptions.radius}, up, up};
    const double mean = mean_of_rectangle(receiver, {-0.7, 0, 0}, {1.4, 0, 0}, {0, 0.7, 0}, towards, kOptions, 1000);
    EXPECT_NEAR(mean, mean_of_wall(distance, towards.z), 2e-3) << distance;
  }
  const AlchemyReceiver corner{{0, 0, 0}, up, up};
  EXPECT_NEAR(mean_of_rectangle(corner, {0, 0, 0}, {0.7, 0, 0}, {0, 0.7, 0}, towards, kOptions, 1000),
              0.5 * mean_of_wall(0, towards.z), 2e-3);
}

TEST_F(AlchemyOfShapes, CornerOfABox) {
  Mesh mesh;
  add_quad(mesh, {0, 0, 0}, {4, 0, 0}, {0, 0, 4});
  add_quad(mesh, {0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  add_quad(mesh, {0, 0, 0}, {0, 0, 4}, {0, 4, 0});
  const glm::dvec3 from = glm::normalize(glm::dvec3(1, 1.4, 0.8));
  const PixelView view = view_of_mesh(mesh, parallel_camera(from, {0, 0, 0}), kWidth, kHeight);
  const auto expected = [&](const SeenPixel& pixel) {
    const AlchemyReceiver receiver{pixel.position, pixel.normal, pixel.normal};
    const glm::dvec3 sides[] = {{1.5, 0, 0}, {0, 1.5, 0}, {0, 0, 1.5}};
    double mean = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (pixel.normal[axis] > 0.5) continue;
      if (pixel.position[axis] < 2 * kPixel) return -1.0;
      mean += mean_of_rectangle(receiver, {0, 0, 0}, sides[(axis + 1) % 3], sides[(axis + 2) % 3], from, kOptions, 200);
    }
    return mean;
  };
  expect_means(view, expected, 0.008, 3);
}

// Two slopes that meet at 130 degrees, seen from above and a little from the side.
TEST_F(AlchemyOfShapes, Groove) {
  const double slope = 25 * kPi / 180;
  const glm::vec3 right(std::cos(slope), std::sin(slope), 0), left(-right.x, right.y, 0);
  Mesh mesh;
  add_quad(mesh, {0, 0, -4}, 4.0f * right, {0, 0, 8});
  add_quad(mesh, {0, 0, -4}, 4.0f * left, {0, 0, 8});
  const glm::dvec3 from = glm::normalize(glm::dvec3(0.2, 1, 0.1));
  const PixelView view = view_of_mesh(mesh, parallel_camera(from, {0, 0, 0}, {0, 0, -1}), kWidth, kHeight);
  const auto expected = [&](const SeenPixel& pixel) {
    if (std::fabs(pixel.position.x) < 2 * kPixel) return -1.0;
    const AlchemyReceiver receiver{pixel.position, pixel.normal, pixel.normal};
    const glm::dvec3 corner(0, 0, pixel.position.z - 0.7), along(0, 0, 1.4);
    return mean_of_rectangle(receiver, corner, along, 0.7 * glm::dvec3(pixel.position.x > 0 ? left : right), from,
                             kOptions, 200);
  };
  expect_means(view, expected, 0.008, 3);
}

// A plate before a wall, farther off than the radius, and nearer.
TEST_F(AlchemyOfShapes, GapsBeyondTheRadiusStayOpen) {
  Mesh mesh;
  add_quad(mesh, {-10, -10, -4}, {20, 0, 0}, {0, 20, 0});
  add_quad(mesh, {-0.5f, -0.4f, -3}, {1, 0, 0}, {0, 0.8f, 0});
  const Camera perspective = straight_camera();
  Camera parallel = perspective;
  parallel.projection = glm::ortho(-2.0f, 2.0f, -1.5f, 1.5f, 0.1f, 20.0f);
  for (const Camera& camera : {perspective, parallel}) {
    const PixelView view = view_of_mesh(mesh, camera, kWidth, kHeight);
    AlchemyOptions options = kOptions;
    options.samples_per_band = 64;
    for (const ObscuranceFalloff falloff :
         {ObscuranceFalloff::cut_off, ObscuranceFalloff::smooth, ObscuranceFalloff::medium, ObscuranceFalloff::low}) {
      options.falloff = falloff;
      options.radius = 0.99f;
      EXPECT_THAT(draw(view, options), Each(0.0f));
      options.radius = 2;
      std::size_t dark_count = 0;
      for (const float value : draw(view, options)) dark_count += value > 0.01f;
      EXPECT_GT(dark_count, 100u);
    }
  }
}

}  // namespace
}  // namespace lkao::gl::tests::alchemy_closed_forms_test
