#include "scene/formats/text.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace lkao::scene {
namespace {

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  std::string_view line;
  while (take_line(text, line)) lines.emplace_back(line);
  return lines;
}

TEST(Text, LinesEndInLfCrOrBoth) {
  EXPECT_EQ(lines_of("a\nb\rc\r\n\r\nd"), (std::vector<std::string>{"a", "b", "c", "", "d"}));
  EXPECT_EQ(lines_of("a\n\rb\r"), (std::vector<std::string>{"a", "", "b"}));
  EXPECT_TRUE(lines_of("").empty());
}

TEST(Text, WordsStandBetweenBlanks) {
  std::string_view text = " \t one\r\n two\v";
  EXPECT_EQ(take_word(text), "one");
  EXPECT_EQ(take_word(text), "two");
  EXPECT_EQ(take_word(text), "");
}

TEST(Text, NumbersOfAllProgramsAreUnderstood) {
  EXPECT_EQ(parse_number(".5"), 0.5);
  EXPECT_EQ(parse_number("-.5"), -0.5);
  EXPECT_EQ(parse_number("+1."), 1.0);
  EXPECT_EQ(parse_number("1E-3"), 1e-3);
  EXPECT_EQ(parse_number("1e-400"), 0.0);
  EXPECT_EQ(parse_number("-1e400"), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(parse_number("-1.#INF"), -std::numeric_limits<double>::infinity());
  for (const char* word : {"nan", "-nan", "NaN", "-nan(ind)", "1.#QNAN", "-1.#IND", "-1.#IND00"}) {
    EXPECT_TRUE(std::isnan(parse_number(word))) << word;
  }
  for (const char* word : {"", "+", "x", "1x", "0,5", "--1", "+-1", "1.5.2", "nano"}) {
    EXPECT_THROW(parse_number(word), std::runtime_error) << word;
  }
}

TEST(Text, ByteOrderMarksAreNoText) {
  EXPECT_EQ(without_byte_order_mark("\xef\xbb\xbf"
                                    "a"),
            "a");
  EXPECT_EQ(without_byte_order_mark("a"), "a");
  EXPECT_THROW(without_byte_order_mark("\xff\xfe"
                                       "a"),
               std::runtime_error);
}

}  // namespace
}  // namespace lkao::scene
