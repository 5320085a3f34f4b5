// Shadow rays (Eq. 3) against the integral with closest hits (Eq. 2), for every falloff, on a scene with everything
// from walls of two triangles to fluted shafts.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "bench/pattern_errors.h"
#include "scene/builtin.h"
#include "scene/camera.h"
#include "support/sanitized.h"

namespace lkao {
namespace {

// Making patterns takes most of the time.
constexpr int kManyRays = tests::unless_sanitized(1024, 256);

const std::vector<bench::PatternError>& errors_in_the_atrium() {
  static const std::vector<bench::PatternError> errors = [] {
    const scene::BuiltinScene& atrium = scene::builtin_scene("atrium");
    const scene::Mesh mesh = scene::make_atrium();
    return bench::measure_pattern_errors(
        mesh, atrium.radii.large, scene::seen_receivers(scene::find_receivers(mesh, atrium.camera, 32, 24)),
        {{PatternKind::lloyd, 128}, {PatternKind::lloyd, kManyRays}, {PatternKind::paper, 128}},
        {.reference_ray_count = 16384, .seed_count = 3});
  }();
  return errors;
}

// The sampling error that is promised: that of as many independent rays, for each of which the answer varies by
// occlusion (1 - occlusion). Stratified rays must keep far below it.
TEST(PatternIntegral, EveryFalloffIsMetWithinTheSamplingError) {
  int checked_count = 0;
  for (const bench::PatternError& error : errors_in_the_atrium()) {
    if (error.what.kind != PatternKind::lloyd) continue;
    const double promised = error.independent_rmse * (error.what.ray_count < 1024 ? 0.5 : 0.35);
    EXPECT_LT(error.rmse, promised) << error.falloff << " " << error.what.ray_count;
    EXPECT_LT(std::abs(error.bias), 1e-3) << error.falloff << " " << error.what.ray_count;
    ++checked_count;
  }
  EXPECT_EQ(checked_count, 2 * 5);
}

// The paper's recipe darkens too little.
TEST(PatternIntegral, PaperIsBiased) {
  for (const bench::PatternError& error : errors_in_the_atrium()) {
    if (error.what.kind != PatternKind::paper) continue;
    EXPECT_LT(error.bias, -2e-3) << error.falloff;
  }
}

}  // namespace
}  // namespace lkao
