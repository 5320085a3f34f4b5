#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "lkao/sample_pattern.h"

namespace lkao {
namespace {

TEST(Falloff, StartsAtOneAndEndsAtZero) {
  for (const char* name : {"linear", "smooth", "exponential"}) {
    const Falloff falloff = Falloff::named(name);
    EXPECT_EQ(falloff.name(), name);
    EXPECT_NEAR(falloff(0), 1.0, 1e-15) << name;
    EXPECT_NEAR(falloff(1), 0.0, 1e-15) << name;
  }
  EXPECT_EQ(Falloff::named("constant")(1), 1.0);
}

TEST(Falloff, HasKnownValues) {
  EXPECT_DOUBLE_EQ(Falloff::linear()(0.25), 0.75);
  EXPECT_DOUBLE_EQ(Falloff::smooth()(0.25), 0.84375);
  EXPECT_DOUBLE_EQ(Falloff::exponential(2)(0.5), (std::exp(-1.0) - std::exp(-2.0)) / (1 - std::exp(-2.0)));
}

TEST(Falloff, LengthIsTheInverse) {
  for (const Falloff& falloff : {Falloff::linear(), Falloff::smooth(), Falloff::exponential(5)}) {
    for (double u = 0.01; u < 1; u += 0.01) EXPECT_NEAR(falloff(falloff.length_at(u)), u, 1e-9) << falloff.name();
  }
  EXPECT_EQ(Falloff::constant().length_at(0.5), 1.0);
}

TEST(Falloff, LengthOfAStepIsItsEdge) {
  const Falloff step = Falloff::custom("step", [](double x) { return x < 0.25 ? 1.0 : x < 0.5 ? 0.5 : 0.0; });
  EXPECT_NEAR(step.length_at(0.9), 0.25, 1e-9);
  EXPECT_NEAR(step.length_at(0.4), 0.5, 1e-9);
  EXPECT_EQ(Falloff::custom("half", [](double) { return 0.5; }).length_at(0.6), 0.0);
}

TEST(Falloff, RefusesWhatIsNoFalloff) {
  EXPECT_THROW(Falloff::custom("rises", [](double x) { return x; }), std::invalid_argument);
  EXPECT_THROW(Falloff::custom("large", [](double) { return 1.5; }), std::invalid_argument);
  EXPECT_THROW(Falloff::custom("negative", [](double x) { return 0.5 - x; }), std::invalid_argument);
  EXPECT_THROW(Falloff::custom("nan", [](double) { return std::nan(""); }), std::invalid_argument);
  EXPECT_THROW(Falloff::custom("none", nullptr), std::invalid_argument);
  EXPECT_THROW(Falloff::named("cubic"), std::invalid_argument);
  for (double rate : {0.0, -1.0, 101.0, std::nan("")}) EXPECT_THROW(Falloff::exponential(rate), std::invalid_argument);
}

}  // namespace
}  // namespace lkao
