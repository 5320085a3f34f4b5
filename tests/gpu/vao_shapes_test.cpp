// The VAO pass on shapes whose free share of the ball is known.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "gpu/on_software.h"
#include "gpu/pass_scene.h"
#include "gpu/vao_definition.h"

namespace lkao::gl::tests::vao_shapes_test {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 72;
constexpr float kRadius = 0.8f;
constexpr float kBall = 0.5f * kRadius;

void add_quad(Mesh& mesh, const std::array<glm::vec3, 4>& corners) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

// All that is left of x = -50 to `end`: a floor, and a block upon it from x = `begin` on, of some height.
Mesh floor_and_blocks(const std::vector<glm::vec3>& blocks) {  // begin, end, height
  constexpr float kFar = 50;
  Mesh mesh;
  add_quad(mesh, {glm::vec3(-kFar, -kFar, 0), {kFar, -kFar, 0}, {kFar, kFar, 0}, {-kFar, kFar, 0}});
  for (const glm::vec3& block : blocks) {
    const float a = block.x, b = block.y, h = block.z;
    add_quad(mesh, {glm::vec3(a, -kFar, 0), {a, kFar, 0}, {a, kFar, h}, {a, -kFar, h}});
    add_quad(mesh, {glm::vec3(b, -kFar, 0), {b, kFar, 0}, {b, kFar, h}, {b, -kFar, h}});
    add_quad(mesh, {glm::vec3(a, -kFar, h), {b, -kFar, h}, {b, kFar, h}, {a, kFar, h}});
  }
  return mesh;
}

// Sees the floor around the origin from one side above, a pixel a fortieth of the ball's radius wide at most.
Camera camera_from(const glm::vec3& eye) {
  return {glm::lookAt(eye, glm::vec3(0), glm::vec3(0, 0, 1)), glm::ortho(-1.2f, 1.2f, -0.9f, 0.9f, 1.0f, 60.0f)};
}

using Solid = std::function<bool(const glm::dvec3&)>;

// The share of a ball within a solid, by the middles of small cubes.
double share_within(const glm::dvec3& centre, const Solid& solid) {
  constexpr int kSide = 24;
  int count = 0, blocked_count = 0;
  for (int i = 0; i < kSide * kSide * kSide; ++i) {
    const glm::dvec3 p =
        (2.0 * glm::dvec3(i % kSide, i / kSide % kSide, i / kSide / kSide) + 1.0) / double{kSide} - 1.0;
    if (glm::dot(p, p) >= 1) continue;
    ++count;
    blocked_count += solid(centre + double{kBall} * p);
  }
  return static_cast<double>(blocked_count) / count;
}

// Of a ball that a plane cuts at `distance` from its centre, the smaller side.
double cap(double distance) {
  const double t = std::fmin(distance / double{kBall}, 1);
  return 0.25 * (1 - t) * (1 - t) * (2 + t);
}

class VaoShapes : public OnSoftware {
 protected:
  void SetUp() override {
    OnSoftware::SetUp();
    if (IsSkipped()) return;
    pass_ = std::make_unique<VaoPass>();
  }
  void TearDown() override { pass_.reset(); }

  // On the floor, where the whole ball is in the picture; returns the largest occlusion that is expected.
  double expect_on_floor(const Mesh& mesh, const glm::vec3& eye,
                         const std::function<double(const glm::dvec3&)>& right) {
    const Camera camera = camera_from(eye);
    const PixelView view = view_of_mesh(mesh, camera, kWidth, kHeight);
    VaoOptions options = converged_vao(kRadius);
    options.sample_count = 1024;
    options.thickness = std::numeric_limits<float>::infinity();
    const std::vector<float> drawn = draw_vao(view, *pass_, options);
    double largest = 0, mean_error = 0;
    int count = 0;
    for (std::size_t i = 0; i < drawn.size(); i += 5) {
      const glm::dvec3 p = view.pixels()[i].position;
      const glm::dvec4 clip = glm::dmat4(camera.projection) * glm::dmat4(camera.view) * glm::dvec4(p.x, p.y, kBall, 1);
      const bool is_within = std::fabs(clip.x) < 1 - kBall / 1.2 && std::fabs(clip.y) < 1 - kBall / 0.9;
      if (!view.pixels()[i].is_there() || std::fabs(p.z) > 1e-6 || !is_within) continue;
      const double expected = right({p.x, p.y, kBall});
      EXPECT_NEAR(drawn[i], expected, 0.04) << p.x << ' ' << p.y;
      mean_error += std::fabs(double{drawn[i]} - expected);
      largest = std::fmax(largest, expected);
      ++count;
    }
    EXPECT_GT(count, 50);
    EXPECT_LT(mean_error / count, 0.01);
    return largest;
  }

  std::unique_ptr<VaoPass> pass_;
};

// What is left is the rounding of positions near the horizon: less than half a step of 8 bits.
TEST_F(VaoShapes, PlanesAreOpenAtAnyAngle) {
  for (const auto& [slope_x, slope_z] : {std::pair{0.0, 0.0}, {0.5, 0.3}, {-1.5, 0.1}, {0.2, -0.05}}) {
    const PixelView view =
        view_of_ground([a = slope_x, b = slope_z](double x, double z) { return -1.5 + a * x + b * z; }, 64, 48);
    for (const VaoOptions& options : {converged_vao(2), plain_set(0.7f, 32), VaoOptions{.radius = 1}}) {
      for (const float value : draw_vao(view, *pass_, options)) ASSERT_NEAR(value, 0, 1.0 / 510);
    }
  }
}

// The paper needs no bias, and neither does this where depths are coarse.
TEST_F(VaoShapes, PlanesAreOpenInEveryFormatOfDepths) {
  const Mesh mesh = floor_and_blocks({});
  const Camera camera{glm::lookAt(glm::vec3(0, -3, 1), glm::vec3(0), glm::vec3(0, 0, 1)),
                      glm::perspective(1.0f, 4.0f / 3, 0.2f, 20.0f)};
  for (const auto& [format, largest] :
       {std::pair{GL_DEPTH_COMPONENT32F, 1e-4}, {GL_DEPTH_COMPONENT24, 1e-4}, {GL_DEPTH_COMPONENT16, 0.03}}) {
    const GBufferPass g_buffer(mesh, camera, 64, 48, {.depth = static_cast<GLenum>(format)});
    const Texture target = make_image(GL_R32F, 64, 48);
    pass_->draw(g_buffer.by_depth(), camera, plain_set(0.5f, 32), {target.name()});
    for (const glm::vec4& texel : read_image(target.name(), 64, 48)) ASSERT_NEAR(texel.x, 0, largest);
  }
}

TEST_F(VaoShapes, AtTheFootOfAWallTheBallIsCutByAPlane) {
  const double largest = expect_on_floor(floor_and_blocks({{0, 50, 40}}), {-20, -7, 25},
                                         [](const glm::dvec3& centre) { return cap(-centre.x); });
  EXPECT_GT(largest, 0.47);  // a half at the foot, as of rays
}

TEST_F(VaoShapes, InACornerThreeQuartersAreBlocked) {
  Mesh mesh = floor_and_blocks({{0, 50, 40}});
  add_quad(mesh, {glm::vec3(-50, 0, 0), {0, 0, 0}, {0, 0, 40}, {-50, 0, 40}});
  const double largest = expect_on_floor(mesh, {-20, -20, 25}, [](const glm::dvec3& centre) {
    return share_within(centre, [](const glm::dvec3& p) { return p.x > 0 || p.y > 0; });
  });
  EXPECT_GT(largest, 0.68);
}

TEST_F(VaoShapes, OfALongLowWallTheBallIsCutTwice) {
  const double largest =
      expect_on_floor(floor_and_blocks({{0, 50, 0.3f}}), {-20, -7, 30}, [](const glm::dvec3& centre) {
        return share_within(centre, [](const glm::dvec3& p) { return p.x > 0 && p.z < 0.3; });
      });
  EXPECT_GT(largest, 0.12);
}

TEST_F(VaoShapes, OfAGrooveTheBallIsCutOnBothSides) {
  // The view lies in planes along the groove: it sees all of it.
  const double largest =
      expect_on_floor(floor_and_blocks({{0.25f, 50, 1}, {-50, -0.25f, 1}}), {0, -20, 25},
                      [](const glm::dvec3& centre) { return cap(0.25 - centre.x) + cap(0.25 + centre.x); });
  EXPECT_GT(largest, 0.45);
}

TEST_F(VaoShapes, WhatIsFarInFrontDarkensNothing) {
  // A board over half of the floor, 3 radii above it.
  Mesh mesh = floor_and_blocks({});
  add_quad(mesh,
           {glm::vec3(-50, -50, 3 * kRadius), {0, -50, 3 * kRadius}, {0, 50, 3 * kRadius}, {-50, 50, 3 * kRadius}});
  const Camera camera{glm::lookAt(glm::vec3(0, 0, 30), glm::vec3(0), glm::vec3(0, 1, 0)),
                      glm::ortho(-1.2f, 1.2f, -0.9f, 0.9f, 1.0f, 60.0f)};
  const PixelView view = view_of_mesh(mesh, camera, kWidth, kHeight);
  VaoOptions options = converged_vao(kRadius);
  options.sample_count = 1024;
  double largest = 0;
  for (const float value : draw_vao(view, *pass_, options)) largest = std::fmax(largest, double{value});
  // Lines under it begin at least two radii below: a share of thickness / 2.
  EXPECT_LT(largest, 0.5 * double{options.thickness} * 0.55);
  EXPECT_GT(largest, 0);
  options.thickness = std::numeric_limits<float>::infinity();
  for (const float value : draw_vao(view, *pass_, options)) largest = std::fmax(largest, double{value});
  EXPECT_GT(largest, 0.45);  // the dark outline of the original method
}

// The same pixels in a picture that is turned by a quarter, and in one that is mirrored.
TEST_F(VaoShapes, TurningAndMirroringThePictureTurnsTheResult) {
  constexpr int kSide = 48, kOther = 36;
  const Mesh mesh = furnished_room();
  const Camera camera = room_camera(kSide, kOther);
  const PixelView view = view_of_mesh(mesh, camera, kSide, kOther);
  Camera turned = camera, mirrored = camera;
  turned.view = glm::rotate(glm::mat4(1), 0.5f * std::numbers::pi_v<float>, glm::vec3(0, 0, 1)) * camera.view;
  std::swap(turned.projection[0][0], turned.projection[1][1]);
  mirrored.projection[0][0] = -camera.projection[0][0];
  std::vector<SeenPixel> turned_pixels(view.pixels().size()), mirrored_pixels = turned_pixels;
  const auto at = [](int x, int y, int width) { return static_cast<std::size_t>(y * width + x); };
  for (int y = 0; y < kOther; ++y) {
    for (int x = 0; x < kSide; ++x) {
      turned_pixels[at(kOther - 1 - y, x, kOther)] = view.pixels()[at(x, y, kSide)];
      mirrored_pixels[at(kSide - 1 - x, y, kSide)] = view.pixels()[at(x, y, kSide)];
    }
  }
  const PixelView turned_view(turned, kOther, kSide, turned_pixels);
  const PixelView mirrored_view(mirrored, kSide, kOther, mirrored_pixels);
  for (const VaoOptions& options : {converged_vao(1), plain_set(1, 32)}) {
    const bool is_converged = options.sample_count > 32;
    const std::vector<float> usual = draw_vao(view, *pass_, options), across = draw_vao(turned_view, *pass_, options),
                             back = draw_vao(mirrored_view, *pass_, options);
    double sum = 0, across_sum = 0, back_sum = 0, largest = 0;
    for (int y = 0; y < kOther; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const double a = usual[at(x, y, kSide)], b = across[at(kOther - 1 - y, x, kOther)],
                     c = back[at(kSide - 1 - x, y, kSide)];
        sum += a;
        across_sum += b;
        back_sum += c;
        largest = std::fmax(largest, std::fmax(std::fabs(a - b), std::fabs(a - c)));
      }
    }
    EXPECT_GT(sum, 50);
    EXPECT_LT(largest, is_converged ? 0.02 : 0.3);
    EXPECT_NEAR(across_sum / sum, 1, is_converged ? 1e-3 : 0.02);
    EXPECT_NEAR(back_sum / sum, 1, is_converged ? 1e-3 : 0.02);
  }
}

}  // namespace
}  // namespace lkao::gl::tests::vao_shapes_test
