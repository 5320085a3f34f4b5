// The far half of the splat pass: spheres of a scene.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "gpu/on_software.h"
#include "gpu/splat_scene.h"

namespace lkao::gl::tests::splat_far_test {
namespace {

constexpr int kWidth = 48;
constexpr int kHeight = 36;
constexpr SphereFormula kFormulas[] = {SphereFormula::cap, SphereFormula::exact, SphereFormula::printed};

// Some with mirrored and turned pictures, off the middle, reversed.
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
          {view, glm::ortho(-4.0f, 4.0f, -3.0f, 3.0f, 0.1f, 20.0f)},
          {view, turned * glm::ortho(-4.0f, 5.0f, -3.0f, 3.0f, 0.1f, 20.0f)}};
}

// Around, before, beside and behind the eye, of all sizes.
std::vector<glm::vec4> random_spheres(const Camera& camera, int count) {
  lut::RandomStream random(11);
  const glm::mat4 world_from_view = glm::inverse(camera.view);
  std::vector<glm::vec4> spheres;
  for (int i = 0; i < count; ++i) {
    const glm::vec3 in_view = lkao::tests::random_point(random, 6) - glm::vec3(0, 0, 3);
    const float size = lkao::tests::uniform(random, 0, 1);
    spheres.emplace_back(glm::vec3(world_from_view * glm::vec4(in_view, 1)), 0.002f + size * size * size);
  }
  return spheres;
}

class SplatFar : public OnSoftware {
 protected:
  void SetUp() override {
    OnSoftware::SetUp();
    if (IsSkipped()) return;
    pass_ = std::make_unique<SplatPass>(SplatPassSetup{.count_fragments = true});
  }
  void TearDown() override { pass_.reset(); }

  // Against the sum in double; how many pixels got something.
  std::size_t expect_sums(const PixelView& view, const std::vector<glm::vec4>& spheres, const SplatOptions& options) {
    pass_->set_spheres(spheres);
    const std::vector<float> drawn = draw_splats(view, *pass_, options);
    std::size_t count = 0, wrong_count = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const SeenPixel& pixel = view.pixels()[i];
      const double expected = pixel.is_there() ? std::fmin(expected_far(pixel, spheres, options), 1.0) : 0;
      count += expected > 0;
      if (std::fabs(drawn[i] - expected) < 2e-5) continue;
      // At the distances where a sphere begins and ends, rounding decides.
      wrong_count += !is_at_an_end(pixel, spheres, options);
    }
    EXPECT_EQ(wrong_count, 0u);
    return count;
  }

  static bool is_at_an_end(const SeenPixel& pixel, const std::vector<glm::vec4>& spheres, const SplatOptions& options) {
    for (const glm::vec4& sphere : spheres) {
      const double distance = glm::length(glm::dvec3(sphere) - pixel.position) / double{sphere.w};
      const double reach = sphere_reach(options.epsilon, options.formula);
      if (std::fabs(distance / reach - 1) < 1e-5 || std::fabs(distance - 1) < 1e-4) return true;
    }
    return false;
  }

  static SplatOptions far_only(float epsilon = 0.01f) {
    return {.near_half = false, .epsilon = epsilon, .inside = InsideSphere::nothing};
  }

  std::unique_ptr<SplatPass> pass_;
};

TEST(SphereReach, IsWhereASphereBlocksEpsilon) {
  // Eq. 5 as it is printed, and (r / d)^2.
  EXPECT_NEAR(sphere_reach(0.01f, SphereFormula::printed), 1 / std::sin(std::acos(1 - 0.01 / (2 * std::numbers::pi))),
              1e-4);
  EXPECT_NEAR(sphere_reach(0.01f, SphereFormula::printed), 17.7, 0.05);
  EXPECT_NEAR(sphere_reach(0.01f, SphereFormula::exact), 10, 1e-5);
  for (const SphereFormula formula : kFormulas) {
    for (const float epsilon : {1e-6f, 0.001f, 0.1f, 1.0f}) {
      EXPECT_NEAR(expected_share(formula, 1.0 / sphere_reach(epsilon, formula), 1), epsilon, 1e-6 + 1e-6 * epsilon);
    }
    for (const float bad : {0.0f, -1.0f, 1.01f, std::numeric_limits<float>::quiet_NaN()}) {
      EXPECT_THROW((void)sphere_reach(bad, formula), std::invalid_argument);
    }
  }
}

TEST_F(SplatFar, OneSphereIsItsClosedForm) {
  for (const Camera& camera : all_cameras()) {
    const PixelView view = random_view(camera, kWidth, kHeight, 3);
    const glm::vec4 in_world = glm::inverse(camera.view) * glm::vec4(0.3f, -0.2f, -4, 1);
    const std::vector<glm::vec4> sphere{{glm::vec3(in_world), 0.35f}};
    for (const SphereFormula formula : kFormulas) {
      for (const float epsilon : {0.1f, 0.01f, 1e-5f}) {
        SplatOptions options = far_only(epsilon);
        options.formula = formula;
        EXPECT_GT(expect_sums(view, sphere, options), epsilon < 0.1f ? 20u : 0u) << epsilon;
      }
    }
  }
}

TEST_F(SplatFar, SpheresAreAddedUpWhereverTheyAre) {
  for (const Camera& camera : all_cameras()) {
    const PixelView view = random_view(camera, kWidth, kHeight, 4);
    const std::vector<glm::vec4> spheres = random_spheres(camera, 200);
    for (const float epsilon : {0.2f, 0.01f}) EXPECT_GT(expect_sums(view, spheres, far_only(epsilon)), 300u);
    for (const InsideSphere inside : {InsideSphere::faded, InsideSphere::everything}) {
      SplatOptions options = far_only();
      options.far_radius = 1.5f;
      options.inside = inside;
      EXPECT_GT(expect_sums(view, spheres, options), 300u);
    }
  }
}

TEST_F(SplatFar, WhatIsAboveTheHorizonIsWhatRaysFind) {
  // A receiver in the middle of the picture, and one sphere at some r / d and angle.
  const Camera camera{glm::mat4(1), glm::perspective(1.0f, 1.0f, 0.1f, 10.0f)};
  const glm::dvec3 normal(0, 0, 1);
  lut::RandomStream random(8);
  for (const double sine : {0.1, 0.3, 0.6, 0.8}) {
    for (const double tilt : {0.0, 0.2}) {
      const PixelView view(camera, 1, 1, {{{0, 0, -2}, normal, normal}});
      const glm::dvec3 centre(std::sin(tilt), 0, std::cos(tilt) - 2);
      pass_->set_spheres(std::vector{glm::vec4(glm::vec3(centre), static_cast<float>(sine))});
      SplatOptions options = far_only();
      options.formula = SphereFormula::exact;
      const double exact = draw_splats(view, *pass_, options)[0];
      // Directions that are as frequent as their cosine.
      const glm::dvec3 to(std::sin(tilt), 0, std::cos(tilt));
      const int ray_count = 400'000;
      int hit_count = 0;
      for (int i = 0; i < ray_count; ++i) {
        const double square = random.next_double(), turn = 2 * std::numbers::pi * random.next_double();
        const glm::dvec3 ray(std::sqrt(square) * std::cos(turn), std::sqrt(square) * std::sin(turn),
                             std::sqrt(1 - square));
        const double along = glm::dot(ray, to);
        hit_count += along > 0 && 1 - along * along <= sine * sine;
      }
      const double share = static_cast<double>(hit_count) / ray_count;
      const double deviation = std::sqrt(share * (1 - share) / ray_count);
      EXPECT_NEAR(exact, share, 4 * deviation) << sine << ' ' << tilt;
      // The paper's cap weighs all of itself by the cosine of its middle.
      options.formula = SphereFormula::cap;
      const double cap = draw_splats(view, *pass_, options)[0];
      EXPECT_NEAR(cap / exact, 2 / (1 + std::sqrt(1 - sine * sine)), 1e-4);
    }
  }
}

TEST_F(SplatFar, SumsEndAtOne) {
  const Camera camera = all_cameras()[0];
  const PixelView view = random_view(camera, kWidth, kHeight, 5);
  const std::vector<glm::vec4> spheres = random_spheres(camera, 3000);
  SplatOptions options = far_only();
  options.formula = SphereFormula::printed;
  pass_->set_spheres(spheres);
  std::size_t full_count = 0;
  for (const float value : draw_splats(view, *pass_, options)) {
    EXPECT_GE(value, 0.0f);
    EXPECT_LE(value, 1.0f);
    full_count += value == 1.0f;
  }
  EXPECT_GT(full_count, 100u);
}

TEST_F(SplatFar, CountsItsFragments) {
  const Camera camera{glm::mat4(1), glm::ortho(-4.0f, 4.0f, -3.0f, 3.0f, 0.1f, 20.0f)};
  const PixelView view = random_view(camera, 80, 60, 6);
  const std::vector<glm::vec4> none;
  pass_->set_spheres(none);
  draw_splats(view, *pass_, far_only());
  EXPECT_EQ(pass_->read_fragment_count(), 0u);
  // (r / d)^2 = 1 / 25 at 5 r = 1: a square of 20 x 20 pixels.
  SplatOptions options = far_only(0.04f);
  options.formula = SphereFormula::exact;
  pass_->set_spheres(std::vector<glm::vec4>{{0, 0, -3, 0.2f}});
  draw_splats(view, *pass_, options);
  EXPECT_NEAR(static_cast<double>(pass_->read_fragment_count()), 400, 45);
  options.far_half = false;
  options.near_half = true, options.near_radius = 1;
  draw_splats(view, *pass_, options);
  EXPECT_EQ(pass_->read_fragment_count(), 0u);
}

TEST_F(SplatFar, SpheresThatAreNoneBlockNothing) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const PixelView view = random_view(all_cameras()[0], kWidth, kHeight, 3);
  pass_->set_spheres(std::vector<glm::vec4>{{0, 0, 0, 0},
                                            {0, 0, 0, -1},
                                            {0, 0, 0, nan},
                                            {0, nan, 0, 1},
                                            {infinity, 0, 0, 1},
                                            {0, 0, 0, infinity},
                                            {0, 0, -2e18f, 1e18f}});
  std::size_t count = 0;
  for (const float value : draw_splats(view, *pass_, far_only())) count += value != 0.0f;
  EXPECT_EQ(count, 0u);
}

TEST_F(SplatFar, SpheresMoveAndChangeTheirNumber) {
  const PixelView view = random_view(all_cameras()[0], kWidth, kHeight, 3);
  std::vector<glm::vec4> spheres = random_spheres(view.camera(), 20);
  EXPECT_GT(expect_sums(view, spheres, far_only()), 100u);
  for (glm::vec4& sphere : spheres) sphere += glm::vec4(0.5f, -0.25f, 0.1f, 0.05f);
  EXPECT_GT(expect_sums(view, spheres, far_only()), 100u);
  spheres.resize(7);
  EXPECT_GT(expect_sums(view, spheres, far_only()), 10u);
  // As a shader would.
  spheres[0] = {0.5f, 1, 0, 0.5f};
  glNamedBufferSubData(pass_->spheres_buffer(), 0, sizeof(glm::vec4), &spheres[0]);
  const std::vector<float> drawn = draw_splats(view, *pass_, far_only());
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const SeenPixel& pixel = view.pixels()[i];
    if (!pixel.is_there() || is_at_an_end(pixel, spheres, far_only())) continue;
    EXPECT_NEAR(drawn[i], std::fmin(expected_far(pixel, spheres, far_only()), 1.0), 2e-5);
  }
}

}  // namespace
}  // namespace lkao::gl::tests::splat_far_test
