#include "method/words.h"

#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace lkao::method {
namespace {

enum class Fruit { apple, pear, plum };
constexpr Word<Fruit> kFruitWords[] = {{"apple", Fruit::apple}, {"pear", Fruit::pear}};

TEST(Words, AreReadAndPrintedByOneTable) {
  for (const auto& [word, fruit] : kFruitWords) {
    EXPECT_EQ(parse_word(kFruitWords, word), fruit);
    EXPECT_EQ(word_of(kFruitWords, fruit), word);
  }
  EXPECT_EQ(word_of(kFruitWords, Fruit::plum), "");
  EXPECT_EQ(list_words(kFruitWords), (std::vector<std::string>{"apple", "pear"}));
}

TEST(Words, OthersAreRefusedWithWhatWasExpected) {
  for (const char* text : {"plum", "Apple", "app", ""}) {
    try {
      parse_word(kFruitWords, text);
      FAIL() << text;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(), "expected apple or pear, got '" + std::string(text) + "'");
    }
  }
}

}  // namespace
}  // namespace lkao::method
