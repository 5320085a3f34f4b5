// The near half of the splat pass: spheres of the pixels around a receiver.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "gpu/on_software.h"
#include "gpu/pass_scene.h"
#include "gpu/splat_scene.h"

namespace lkao::gl::tests::splat_near_test {
namespace {

constexpr int kWidth = 40;
constexpr int kHeight = 30;
constexpr SplatOptions kAll{
    .far_half = false, .near_radius = 0.5f, .samples_per_pixel = 1e6f, .max_sample_count = 16384};

PixelView view_of_waves() {
  return view_of_ground([](double x, double z) { return -1.2 + 0.15 * std::sin(6 * x) * std::cos(5 * z); }, kWidth,
                        kHeight);
}

// The mean over seeds against the sum over all pixels; the variance of a pixel of one seed, over the pixels.
double expect_right_on_average(const PixelView& view, SplatPass& pass, SplatOptions options) {
  const std::vector<float> right = draw_splats(view, pass, options);
  options.samples_per_pixel = 2;
  options.max_sample_count = 12;
  constexpr int kSeedCount = 300;
  std::vector<double> sums(right.size()), squares(right.size());
  for (int seed = 0; seed < kSeedCount; ++seed) {
    options.seed = static_cast<std::uint32_t>(seed);
    const std::vector<float> drawn = draw_splats(view, pass, options);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      sums[i] += drawn[i];
      squares[i] += double{drawn[i]} * drawn[i];
    }
  }
  // No pixel may be farther off than its own spread lets it, nor all together.
  double squared_offs = 0, off = 0, variance_of_all = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < right.size(); ++i) {
    const double mean = sums[i] / kSeedCount, variance = squares[i] / kSeedCount - mean * mean;
    if (right[i] < 0.01f) continue;
    off += mean - double{right[i]};
    variance_of_all += variance / kSeedCount;
    squared_offs += (mean - right[i]) * (mean - right[i]) * kSeedCount / variance;
    ++count;
  }
  EXPECT_GT(count, 100u);
  EXPECT_LT(std::fabs(off), 4 * std::sqrt(variance_of_all));
  EXPECT_NEAR(squared_offs / static_cast<double>(count), 1, 0.3);
  return variance_of_all * kSeedCount / static_cast<double>(count);
}

class SplatNear : public OnSoftware {
 protected:
  void SetUp() override {
    OnSoftware::SetUp();
    if (IsSkipped()) return;
    pass_ = std::make_unique<SplatPass>();
  }
  void TearDown() override { pass_.reset(); }

  // Of all pixels of the discs, against the sum in double; the sum of all that was expected.
  double expect_sums(const PixelView& view, const SplatOptions& options, const PixelView* behind = nullptr) {
    const std::vector<float> drawn = draw_splats(view, *pass_, options, behind);
    std::vector<const PixelView*> layers{&view};
    if (behind != nullptr) layers.push_back(behind);
    double sum = 0;
    std::size_t wrong_count = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const double expected =
          view.pixels()[i].is_there() ? std::fmin(expected_near(view, i, layers, options), 1.0) : 0.0;
      sum += expected;
      wrong_count += !(std::fabs(drawn[i] - expected) < 2e-4);
    }
    // A pixel whose distance is the radius, to a rounding, may be in or out.
    EXPECT_LE(wrong_count, drawn.size() / 500);
    return sum;
  }

  std::unique_ptr<SplatPass> pass_;
};

TEST_F(SplatNear, NothingOfAPlaneIsAboveItsHorizon) {
  for (const auto& [slope_x, slope_z] : {std::pair{0.0, 0.0}, {0.5, 0.3}, {-1.5, 0.1}, {0.2, -0.05}}) {
    const PixelView view =
        view_of_ground([a = slope_x, b = slope_z](double x, double z) { return -1.5 + a * x + b * z; }, 120, 90);
    SplatOptions options = kAll;
    options.near_radius = 1;
    options.max_sample_count = 500;
    std::size_t count = 0;
    for (const float value : draw_splats(view, *pass_, options)) count += value != 0;
    EXPECT_EQ(count, 0u) << slope_x << ' ' << slope_z;
  }
}

TEST_F(SplatNear, IsTheSumOverAllPixelsOfTheDisc) {
  const PixelView waves = view_of_waves();
  EXPECT_GT(expect_sums(waves, kAll), 5);
  for (const SphereFormula formula : {SphereFormula::exact, SphereFormula::printed}) {
    SplatOptions options = kAll;
    options.formula = formula;
    options.near_radius = 2;
    options.pixel_sphere_radius = 0.8f;
    EXPECT_GT(expect_sums(waves, options), 20);
  }
  // Points that are no surface: spheres everywhere, many below horizons, some around receivers.
  SplatOptions options = kAll;
  options.near_radius = 3;
  Camera parallel = straight_camera();
  parallel.projection = glm::ortho(-4.0f, 4.0f, -3.0f, 3.0f, 0.1f, 20.0f);
  for (const Camera& camera : {straight_camera(), parallel}) {
    EXPECT_GT(expect_sums(random_view(camera, kWidth, kHeight, 9), options), 10);
  }
}

TEST_F(SplatNear, OfFewSamplesIsRightOnAverage) {
  const PixelView view = view_of_waves();
  SplatOptions options = kAll;
  options.near_radius = 1;
  options.pixel_sphere_radius = 0.3f;  // so that no sum ends at 1
  options.density = SampleDensity::even;
  const double even = expect_right_on_average(view, *pass_, options);
  options.density = SampleDensity::falling;
  EXPECT_LT(expect_right_on_average(view, *pass_, options), 0.7 * even);
}

TEST_F(SplatNear, SamplesDifferFromPixelToPixelAndSeedToSeed) {
  const PixelView view = view_of_waves();
  SplatOptions options = kAll;
  options.max_sample_count = 12;
  const std::vector<float> first = draw_splats(view, *pass_, options);
  EXPECT_EQ(draw_splats(view, *pass_, options), first);
  options.seed = 1;
  EXPECT_NE(draw_splats(view, *pass_, options), first);
}

// A curtain before the left half of a floor hides a wall that stands on the floor and ends where the curtain does.
TEST_F(SplatNear, TwoLayersSeeWhatOneMisses) {
  const Camera camera = straight_camera();
  std::vector<SeenPixel> front(std::size_t{kWidth} * kHeight), behind = front;
  const glm::dvec3 up(0, 1, 0), right(1, 0, 0), towards(0, 0, 1);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto i = static_cast<std::size_t>(y * kWidth + x);
      const auto at = [&](double along) {
        return glm::dvec3(glm::vec3(seen_at(camera, kWidth, kHeight, x, y, along)));
      };
      const glm::dvec3 ray = at(1);
      const bool is_left = x < kWidth / 2;
      if (ray.y >= 0) continue;
      const SeenPixel floor{at(-1 / ray.y), up, up};
      if (!is_left) front[i] = floor;
      if (is_left) front[i] = {at(0.5), towards, towards};
      // The wall x = -0.1 from the floor up to half the height of the eye.
      const double wall = -0.1 / ray.x;
      if (is_left) behind[i] = ray.y * wall > -1 && ray.y * wall < -0.5 ? SeenPixel{at(wall), right, right} : floor;
    }
  }
  const PixelView view(camera, kWidth, kHeight, front), second(camera, kWidth, kHeight, behind);
  EXPECT_EQ(expect_sums(view, kAll), 0);
  EXPECT_GT(expect_sums(view, kAll, &second), 0.1);
  // Nothing of it stays for the next frame.
  EXPECT_EQ(expect_sums(view, kAll), 0);
}

TEST_F(SplatNear, AnyGBufferWillDo) {
  const Mesh mesh = furnished_room();
  const Camera camera = room_camera(kWidth, kHeight);
  const GBufferPass g_buffer(mesh, camera, kWidth, kHeight);
  const Texture target = make_image(GL_R32F, kWidth, kHeight);
  std::vector<std::vector<float>> all;
  for (const GBuffer& textures :
       {g_buffer.by_positions(), g_buffer.by_depth(), g_buffer.by_linear_depth(), g_buffer.by_view_positions()}) {
    pass_->draw(textures, camera, kAll, {target.name()});
    all.emplace_back();
    for (const glm::vec4& texel : read_image(target.name(), kWidth, kHeight)) all.back().push_back(texel.x);
  }
  double largest = 0, sum = 0;
  for (std::size_t i = 0; i < all[0].size(); ++i) {
    sum += all[0][i];
    for (const std::vector<float>& other : all) largest = std::fmax(largest, std::fabs(other[i] - all[0][i]));
  }
  EXPECT_GT(sum, 20);
  EXPECT_LT(largest, 0.01);
}

TEST_F(SplatNear, ShadingNormalsDoNotDarkenWhatIsFlat) {
  const PixelView flat = view_of_ground([](double, double) { return -1.2; }, kWidth, kHeight);
  std::vector<SeenPixel> pixels = flat.pixels();
  for (SeenPixel& pixel : pixels) {
    if (pixel.is_there()) pixel.normal = glm::normalize(glm::dvec3(0.3, 1, -0.2));
  }
  const PixelView shaded(flat.camera(), kWidth, kHeight, pixels);
  for (const float value : draw_splats(shaded, *pass_, kAll)) ASSERT_EQ(value, 0);
}

}  // namespace
}  // namespace lkao::gl::tests::splat_near_test
