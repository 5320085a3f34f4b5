#include "method/radius.h"

#include <gtest/gtest.h>

namespace lkao::method {
namespace {

const Bounds kBox{{1, 1, 1}, {4, 5, 1}};  // of diagonal 5

TEST(Radius, IsALengthOrEndless) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(parse_radius("0.5").in(kBox), 0.5);
  for (const char* text : {"inf", "infinity", "+inf"}) EXPECT_EQ(parse_radius(text).in(kBox), kInfinity) << text;
}

TEST(Radius, IsAShareOfTheDiagonal) {
  EXPECT_DOUBLE_EQ(parse_radius("5%").in(kBox), 0.25);
  EXPECT_DOUBLE_EQ(parse_radius("+1e2%").in(kBox), 5);
  EXPECT_DOUBLE_EQ(parse_radius("250%").in(kBox), 12.5);
}

TEST(Radius, RejectsEverythingElse) {
  for (const char* text : {"0", "-1", "-inf", "nan", "1e999", "1e39", "1e-60", "inf1", "in", "", "%", "0%", "-5%",
                           "inf%", "nan%", "5 %", "5%%", "%5", "5%m"}) {
    EXPECT_THROW(parse_radius(text), std::invalid_argument) << text;
  }
}

TEST(Radius, RejectsSharesThatAreNoLength) {
  EXPECT_THROW(parse_radius("5%").in({glm::vec3(1), glm::vec3(1)}), std::invalid_argument);
  EXPECT_THROW(parse_radius("1e38%").in({glm::vec3(0), glm::vec3(1e5f)}), std::invalid_argument);
}

}  // namespace
}  // namespace lkao::method
