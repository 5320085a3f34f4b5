#include "cli/parse.h"

#include <limits>

#include <gtest/gtest.h>

namespace lkao::cli {
namespace {

TEST(Parse, ReadsNumbersAsWritten) {
  EXPECT_EQ(parse_number("-1.5e2"), -150);
  EXPECT_EQ(parse_number("+0.75"), 0.75);
  EXPECT_EQ(parse_number(".5"), 0.5);
}

TEST(Parse, RejectsWhatIsNoFiniteFloat) {
  for (const char* text : {"", " 1", "1 ", "1,5", "1m", "nan", "inf", "-inf", "1e999", "1e39", "0x10", "--1", "+-1"}) {
    EXPECT_THROW(parse_number(text), std::invalid_argument) << "'" << text << "'";
  }
}

TEST(Parse, WantsPositiveNumbersThatAreFloatsAboveZero) {
  EXPECT_EQ(parse_positive_number("1e-30"), 1e-30);
  for (const char* text : {"0", "-0", "-1", "1e-60", "1e-999", "nan"}) {
    EXPECT_THROW(parse_positive_number(text), std::invalid_argument) << text;
  }
}

TEST(Parse, RayCountsAreFrom1To1024) {
  for (int count = 1; count <= 1024; ++count) EXPECT_EQ(parse_ray_count(std::to_string(count)), count);
  for (const char* text : {"0", "-64", "1025", "1088", "64.0", "4294967360", "many"}) {
    EXPECT_THROW(parse_ray_count(text), std::invalid_argument) << text;
  }
}

TEST(Parse, VectorsHaveThreeNumbers) {
  EXPECT_EQ(parse_vector("-1,.5,1e3"), glm::vec3(-1, 0.5f, 1000));
  for (const char* text : {"", "1,2", "1,2,3,4", "1,,3", "1,2,nan", "1;2;3", "1, 2, 3"}) {
    EXPECT_THROW(parse_vector(text), std::invalid_argument) << text;
  }
}

TEST(Parse, PositionsKeepWhatFloatsLose) {
  EXPECT_EQ(parse_position("448262.013,5413678.257,-112"), glm::dvec3(448262.013, 5413678.257, -112));
  EXPECT_THROW(parse_position("1,2,inf"), std::invalid_argument);
}

TEST(Parse, SizesAreWithinLimits) {
  EXPECT_EQ(parse_size("1x32768").height, 32768);
  EXPECT_EQ(parse_size("16384x16384").width, 16384);
  for (const char* text : {"", "64", "64x", "x64", "0x64", "64x0", "-1x64", "32769x1", "32768x32768", "1x2x3", "6.5x4",
                           "99999999999x1", "64X64"}) {
    EXPECT_THROW(parse_size(text), std::invalid_argument) << text;
  }
}

TEST(Parse, FieldsOfViewAreOpenIntervals) {
  EXPECT_EQ(parse_field_of_view("80"), 80);
  for (const char* text : {"0", "180", "-60", "nan", "179.9999999999"}) {
    EXPECT_THROW(parse_field_of_view(text), std::invalid_argument) << text;
  }
}

TEST(Parse, SeedsTakeAllBits) {
  EXPECT_EQ(parse_seed("18446744073709551615"), std::numeric_limits<std::uint64_t>::max());
  for (const char* text : {"-1", "18446744073709551616", "1.0", ""}) {
    EXPECT_THROW(parse_seed(text), std::invalid_argument) << text;
  }
}

TEST(Parse, SaysWhatWasExpectedAndWhatItGot) {
  try {
    parse_ray_count("0");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "expected a whole number from 1 to 1024, got '0'");
  }
}

}  // namespace
}  // namespace lkao::cli
