// Converged horizons and masks against closed forms of ambient occlusion, in scenes of which the screen shows all that
// counts; and what thickness is for.
#include <gmock/gmock.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "gpu/horizon_scene.h"
#include "gpu/on_software.h"
#include "support/sanitized.h"

namespace lkao::gl::tests::horizon_scenes_test {
namespace {

using lkao::tests::add_quad;

constexpr double kPi = std::numbers::pi;
constexpr int kWidth = lkao::tests::kIsSanitized ? 48 : 96;
constexpr int kHeight = lkao::tests::kIsSanitized ? 36 : 72;
constexpr float kAspect = 4.0f / 3;

// The share of cosine-weighted directions around y that a test blocks: those over a disc, which Malley's method lifts.
double blocked_share(const std::function<bool(const glm::dvec3&)>& is_blocked) {
  constexpr int kCount = 120;
  int count = 0, all = 0;
  for (int i = 0; i < kCount; ++i) {
    for (int j = 0; j < kCount; ++j) {
      const double x = 2 * (i + 0.5) / kCount - 1, z = 2 * (j + 0.5) / kCount - 1, height = 1 - x * x - z * z;
      if (height <= 0) continue;
      ++all;
      count += is_blocked({x, std::sqrt(height), z});
    }
  }
  return static_cast<double>(count) / all;
}

// Directions around y whose component towards a plane reaches it within the radius, so many radii away: those over a
// segment of a disc.
double by_endless_wall(double away) {
  return away < 1 ? (std::acos(away) - away * std::sqrt(1 - away * away)) / kPi : 0;
}

class HorizonScenes : public OnSoftware {
 protected:
  void SetUp() override {
    OnSoftware::SetUp();
    if (IsSkipped()) return;
    pass_ = std::make_unique<HorizonPass>();
  }
  void TearDown() override { pass_.reset(); }

  // Of the pixels for which there is an answer (not NaN), in pictures that are 72 pixels high: the mean error may be no
  // larger than `mean`, the RMSE than `rmse`. Edges are known to half a pixel, so both grow with it. They are noted
  // down under `name`.
  using Truth = std::function<double(const SeenPixel&)>;
  void expect_truth(const std::string& name, const PixelView& view, const HorizonOptions& options, const Truth& truth,
                    double mean, double rmse) {
    const std::vector<double> drawn = draw_converged(view, *pass_, options);
    double sum = 0, squares = 0, all = 0;
    int count = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const double expected = view.pixels()[i].is_there() ? truth(view.pixels()[i]) : std::nan("");
      if (std::isnan(expected)) continue;
      const double off = drawn[i] - expected;
      sum += off, squares += off * off, all += expected, ++count;
    }
    constexpr double kPixel = kHeight == 72 ? 1 : 2.5;
    ASSERT_GT(count, 25) << name;
    RecordProperty(name, std::to_string(sum / count) + ", RMSE " + std::to_string(std::sqrt(squares / count)));
    EXPECT_GT(all / count, 0.03) << name;
    EXPECT_LT(std::fabs(sum / count), mean * kPixel) << name;
    EXPECT_LT(std::sqrt(squares / count), rmse * kPixel) << name;
  }

  std::unique_ptr<HorizonPass> pass_;
};

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
const char* name_of(HorizonEstimator estimator) {
  return estimator == HorizonEstimator::bitmask ? "bitmask" : "horizons";
}

TEST_F(HorizonScenes, TheFootOfAWall) {
  Mesh mesh;
  add_quad(mesh, {0, 0, -8}, {8, 0, 0}, {0, 0, 16});
  add_quad(mesh, {0, 0, -8}, {0, 8, 0}, {0, 0, 16});
  const PixelView view = view_of_mesh(mesh, looking({3, 3, 0}, {0.2f, 0.2f, 0}, kAspect), kWidth, kHeight);
  const auto truth = [](const SeenPixel& pixel) {
    const bool is_floor = pixel.normal.y > 0.5;
    const double away = is_floor ? pixel.position.x : pixel.position.y;
    // Of nearer ones the foot is within a pixel.
    const bool is_inside = std::fabs(pixel.position.z) < 0.5 && away > 0.06 && away < 0.95;
    return is_inside ? by_endless_wall(away) : kNone;
  };
  for (const HorizonEstimator estimator : kEstimators) {
    expect_truth(name_of(estimator), view, {.estimator = estimator, .radius = 1}, truth, 0.01, 0.012);
  }
  expect_truth("even", view, {.radius = 1, .slice_density = SliceDensity::even}, truth, 0.01, 0.012);
  // Walls as thick as the radius is long block what endless ones do.
  const HorizonOptions thick{.estimator = HorizonEstimator::bitmask, .radius = 1, .thickness = 1};
  expect_truth("thick", view, thick, truth, 0.01, 0.012);
  // Sectors of equal angles do not: there the papers' measure is another.
  HorizonOptions angles = thick;
  angles.sector_measure = SectorMeasure::angle;
  angles.slice_density = SliceDensity::even;
  const std::vector<double> cosine = draw_converged(view, *pass_, thick, 1),
                            angle = draw_converged(view, *pass_, angles, 1);
  double off = 0;
  for (std::size_t i = 0; i < cosine.size(); ++i) off = std::fmax(off, std::fabs(angle[i] - cosine[i]));
  EXPECT_GT(off, 0.05);
}

TEST_F(HorizonScenes, TheFootOfAWallWithALinearFalloff) {
  Mesh mesh;
  add_quad(mesh, {0, 0, -8}, {8, 0, 0}, {0, 0, 16});
  add_quad(mesh, {0, 0, -8}, {0, 8, 0}, {0, 0, 16});
  const PixelView view = view_of_mesh(mesh, looking({3, 3, 0}, {0.2f, 0.2f, 0}, kAspect), kWidth, kHeight);
  // Rays of all lengths up to 1, as many of each: the mean over the radius.
  const auto truth = [](const SeenPixel& pixel) {
    const double away = pixel.normal.y > 0.5 ? pixel.position.x : pixel.position.y;
    if (std::fabs(pixel.position.z) > 0.5 || away < 0.06 || away > 0.95) return kNone;
    double sum = 0;
    for (int i = 0; i < 100; ++i) sum += by_endless_wall(away / ((i + 0.5) / 100)) / 100;
    return sum;
  };
  const HorizonOptions options{.estimator = HorizonEstimator::bitmask, .radius = 1, .falloff_begin = 0};
  expect_truth("bitmask", view, options, truth, 0.01, 0.012);
}

TEST_F(HorizonScenes, TheCornerOfABox) {
  Mesh mesh;
  add_quad(mesh, {0, 0, 0}, {8, 0, 0}, {0, 0, 8});
  add_quad(mesh, {0, 0, 0}, {0, 8, 0}, {0, 0, 8});
  add_quad(mesh, {0, 0, 0}, {0, 8, 0}, {8, 0, 0});
  const PixelView view = view_of_mesh(mesh, looking({3, 3, 3}, {0.4f, 0.4f, 0.4f}, kAspect), kWidth, kHeight);
  const auto truth = [](const SeenPixel& pixel) {
    const glm::dvec3& p = pixel.position;
    if (std::fmin(p.x, p.z) < 0.06 || p.y > 0.5 || pixel.normal.y < 0.5 || std::fmax(p.x, p.z) > 0.9) return kNone;
    return blocked_share([&](const glm::dvec3& ray) { return -ray.x > p.x || -ray.z > p.z; });
  };
  for (const HorizonEstimator estimator : kEstimators) {
    expect_truth(name_of(estimator), view, {.estimator = estimator, .radius = 1}, truth, 0.02, 0.025);
  }
}

TEST_F(HorizonScenes, ALongWall) {
  constexpr double kTop = 1, kEnd = 2.5;
  Mesh mesh;
  add_quad(mesh, {-8, 0, -8}, {16, 0, 0}, {0, 0, 16});
  add_quad(mesh, {0, 0, -kEnd}, {0, kTop, 0}, {0, 0, 2 * kEnd});
  const PixelView view = view_of_mesh(mesh, looking({3.5f, 4, 0}, {0.3f, 0.4f, 0}, kAspect, 1.0f), kWidth, kHeight);
  // What the rectangle covers of the receiver's sky.
  const auto truth = [](const SeenPixel& pixel) {
    const glm::dvec3& p = pixel.position;
    if (pixel.normal.y < 0.5 || p.x < 0.1 || p.x > 1.5 || std::fabs(p.z) > 1) return kNone;
    return blocked_share([&](const glm::dvec3& ray) {
      const glm::dvec3 hit = p + ray * (p.x / -ray.x);
      return ray.x < 0 && hit.y < kTop && std::fabs(hit.z) < kEnd;
    });
  };
  for (const HorizonEstimator estimator : kEstimators) {
    expect_truth(name_of(estimator), view, {.estimator = estimator, .radius = 9}, truth, 0.018, 0.02);
  }
}

// Seen from straight above: no pixel shows a wall, but a height field has them.
TEST_F(HorizonScenes, AGroove) {
  constexpr double kHalf = 0.5, kDepth = 0.6;
  Mesh mesh;
  add_quad(mesh, {-kHalf, 0, -8}, {2 * kHalf, 0, 0}, {0, 0, 16});
  add_quad(mesh, {kHalf, kDepth, -8}, {8, 0, 0}, {0, 0, 16});
  add_quad(mesh, {-kHalf - 8, kDepth, -8}, {8, 0, 0}, {0, 0, 16});
  const PixelView view = view_of_mesh(mesh, from_above(1.6f, kAspect), kWidth, kHeight);
  const auto truth = [](const SeenPixel& pixel) {
    if (pixel.position.y > 0.1 || std::fabs(pixel.position.z) > 0.6) return kNone;
    return blocked_share([&](const glm::dvec3& ray) {
      const double to_wall = (kHalf - std::copysign(pixel.position.x, pixel.position.x * ray.x)) / std::fabs(ray.x);
      return to_wall < 1 && to_wall * ray.y < kDepth;
    });
  };
  for (const HorizonEstimator estimator : kEstimators) {
    // An edge lies up to a pixel before the first centre that shows what is above it.
    expect_truth(name_of(estimator), view, {.estimator = estimator, .radius = 1}, truth, 0.04, 0.045);
  }
}

// A shelf over a floor, seen from above: light comes from below it, which a height field does not know.
TEST_F(HorizonScenes, LightPassesBehindWhatIsThin) {
  const glm::dvec3 lower(0.2, 0.4, -8), upper(0.7, 0.6, 8);
  Mesh mesh;
  add_quad(mesh, {-8, 0, -8}, {16, 0, 0}, {0, 0, 16});
  add_quad(mesh, {lower.x, upper.y, lower.z}, {upper.x - lower.x, 0, 0}, {0, 0, upper.z - lower.z});
  const PixelView view = view_of_mesh(mesh, from_above(1.7f, kAspect), kWidth, kHeight);
  const auto truth = [&](const SeenPixel& pixel) {
    const glm::dvec3& p = pixel.position;
    if (p.y > 0.1 || p.x > 0.15 || p.x < -0.5 || std::fabs(p.z) > 0.6) return kNone;
    return blocked_share([&](const glm::dvec3& ray) {
      const glm::dvec3 a = (lower - p) / ray, b = (upper - p) / ray, first = glm::min(a, b), last = glm::max(a, b);
      const double enters = std::fmax(first.x, std::fmax(first.y, first.z));
      return enters < 1 && enters < std::fmin(last.x, std::fmin(last.y, last.z)) && enters > 0;
    });
  };
  HorizonOptions options{.estimator = HorizonEstimator::bitmask, .radius = 1, .thickness = 0.2f};
  expect_truth("thin", view, options, truth, 0.03, 0.035);
  const auto sum_of = [&](const HorizonOptions& wanted) {
    const std::vector<double> drawn = draw_converged(view, *pass_, wanted, 1);
    double sum = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) sum += std::isnan(truth(view.pixels()[i])) ? 0 : drawn[i];
    return sum;
  };
  const double thin = sum_of(options);
  options.thickness = std::numeric_limits<float>::infinity();
  const double endless = sum_of(options);
  options.estimator = HorizonEstimator::horizons;
  EXPECT_NEAR(sum_of(options), endless, 0.03 * endless);
  options.thickness = 1;
  EXPECT_LT(sum_of(options), 0.9 * endless) << "horizons sink";
  EXPECT_GT(endless, 1.3 * thin);
}

TEST_F(HorizonScenes, NothingIsDarkAcrossGapsLargerThanTheRadius) {
  Mesh mesh;
  add_quad(mesh, {-8, 0, -8}, {16, 0, 0}, {0, 0, 16});
  add_quad(mesh, {0.2f, 1.2f, -0.5f}, {0.5f, 0, 0}, {0, 0, 1});
  const Camera cameras[] = {looking({3, 3, 0}, {0.4f, 0, 0}, kAspect), from_above(2, kAspect)};
  for (const Camera& camera : cameras) {
    const PixelView view = view_of_mesh(mesh, camera, 64, 48);
    for (const HorizonEstimator estimator : kEstimators) {
      const HorizonOptions options{.estimator = estimator, .radius = 1.15f};
      const std::vector<float> drawn = draw_horizons(view, *pass_, options);
      for (std::size_t i = 0; i < drawn.size(); ++i) ASSERT_NEAR(drawn[i], 0, 1e-6) << i;
      HorizonOptions longer = options;
      longer.radius = 1.5f;
      EXPECT_THAT(draw_horizons(view, *pass_, longer), testing::Contains(testing::Gt(0.1f)));
    }
  }
}

}  // namespace
}  // namespace lkao::gl::tests::horizon_scenes_test
