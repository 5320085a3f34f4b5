#include "image/metrics.h"

#include <cmath>

#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace lkao::image::metrics_test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
using Values = std::vector<float>;

TEST(Metrics, EqualImagesHaveNoErrorAndInfinitePsnr) {
  const Values a = {0.0f, 0.25f, 1.0f};
  const Metrics metrics = compare(a, a);
  EXPECT_EQ(metrics.mae, 0);
  EXPECT_EQ(metrics.rmse, 0);
  EXPECT_EQ(metrics.max_error, 0);
  EXPECT_EQ(metrics.psnr, std::numeric_limits<double>::infinity());
  EXPECT_EQ(metrics.equal_8bit_share, 1);
  EXPECT_EQ(metrics.value_count, 3u);
}

TEST(Metrics, MatchesHandComputedValues) {
  // Errors 0, 0.5, 0.25, 0.25 (either sign): sum 1, squares 0.375.
  const Metrics metrics = compare(Values{0, 0.5f, 0.25f, 1}, Values{0, 0, 0.5f, 0.75f});
  EXPECT_DOUBLE_EQ(metrics.mae, 0.25);
  EXPECT_DOUBLE_EQ(metrics.rmse, std::sqrt(0.09375));
  EXPECT_DOUBLE_EQ(metrics.max_error, 0.5);
  EXPECT_NEAR(metrics.psnr, 10.28029, 1e-5);  // 10 log10(1 / 0.09375)
  EXPECT_DOUBLE_EQ(metrics.equal_8bit_share, 0.25);
}

TEST(Metrics, IsSymmetric) {
  const Values a = {0.1f, kNaN, 0.7f, 0.3f};
  const Values b = {0.2f, 0.5f, 0.1f, kNaN};
  const Metrics ab = compare(a, b);
  const Metrics ba = compare(b, a);
  EXPECT_EQ(ab.mae, ba.mae);
  EXPECT_EQ(ab.rmse, ba.rmse);
  EXPECT_EQ(ab.equal_8bit_share, ba.equal_8bit_share);
}

TEST(Metrics, NanInBothIsLeftOut) {
  const Metrics metrics = compare(Values{kNaN, 0.5f, kNaN}, Values{kNaN, 0.25f, kNaN});
  EXPECT_EQ(metrics.value_count, 1u);
  EXPECT_EQ(metrics.mae, 0.25);
}

TEST(Metrics, NanInOneIsAnErrorOfOne) {
  const Metrics metrics = compare(Values{kNaN, 0.5f}, Values{0.999f, 0.5f});
  EXPECT_EQ(metrics.value_count, 2u);
  EXPECT_EQ(metrics.mae, 0.5);
  EXPECT_EQ(metrics.max_error, 1);
  EXPECT_EQ(metrics.equal_8bit_share, 0.5);
}

TEST(Metrics, NothingToCompareIsEqual) {
  const Metrics metrics = compare(Values{kNaN}, Values{kNaN});
  EXPECT_EQ(metrics.value_count, 0u);
  EXPECT_EQ(metrics.mae, 0);
  EXPECT_EQ(metrics.rmse, 0);
  EXPECT_EQ(metrics.psnr, std::numeric_limits<double>::infinity());
  EXPECT_EQ(metrics.equal_8bit_share, 1);
}

TEST(Metrics, EqualInfinitiesAreEqual) {
  EXPECT_EQ(compare(Values{kInfinity, -kInfinity}, Values{kInfinity, -kInfinity}).max_error, 0);
  EXPECT_EQ(compare(Values{kInfinity}, Values{1}).max_error, std::numeric_limits<double>::infinity());
}

TEST(Metrics, EqualAtEightBitsRoundsAndClamps) {
  // 100.4 and 99.6 round to 100, 100.6 to 101; what is outside [0, 1] is clamped.
  const Values a = {100.4f / 255, 100.4f / 255, 1.5f, -3.0f};
  const Values b = {99.6f / 255, 100.6f / 255, 1.0f, 0.0f};
  EXPECT_DOUBLE_EQ(compare(a, b).equal_8bit_share, 0.75);
}

TEST(Metrics, SumsManySmallErrorsInDouble) {
  // A float sum of these stops growing far below the true mean.
  const std::size_t count = 20'000'000;
  const Values a(count, 0.75f);
  const Values b(count, 0.5f);
  EXPECT_DOUBLE_EQ(compare(a, b).mae, 0.25);
}

TEST(Metrics, SizesThatDifferAreNamed) {
  try {
    compare(Values{1, 2}, Values{1, 2, 3});
    FAIL() << "nothing was thrown";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "cannot compare 2 values with 3");
  }
}

}  // namespace
}  // namespace lkao::image::metrics_test
