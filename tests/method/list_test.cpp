// What holds of every method in the list.
#include "method/list.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace lkao::method {
namespace {

TEST(MethodList, HasEveryWordOnce) {
  const std::vector<std::string> words = method_words();
  EXPECT_EQ(std::set<std::string>(words.begin(), words.end()).size(), words.size());
  for (const std::string& word : words) EXPECT_EQ(method_named(word).word, word);
  EXPECT_EQ(traversal().word, "bvh");
  EXPECT_THROW(method_named("gpu"), std::invalid_argument);
}

TEST(MethodList, NoMethodIsItsOwnReference) {
  for (const MethodKind& kind : method_kinds()) {
    const MethodKind& reference = reference_of(kind);
    EXPECT_NE(reference.word, kind.word);
    EXPECT_TRUE(reference.abilities({}).masks && reference.abilities({}).any_receivers) << kind.word;
  }
}

TEST(MethodList, SettingsHaveNamesOfTheirOwnAndUsableDefaults) {
  std::set<const Setting*> settings;
  std::set<std::string> names;
  for (const MethodKind& kind : method_kinds()) {
    for (const Setting* setting : kind.settings) {
      EXPECT_NO_THROW(setting->check(setting->default_text)) << setting->name;
      EXPECT_FALSE(setting->help.empty() || setting->help.ends_with('.')) << setting->name;
      if (settings.insert(setting).second) {
        EXPECT_TRUE(names.insert(setting->name).second) << setting->name;
      }
      const std::vector<std::string> words = words_of_methods_with(*setting);
      EXPECT_EQ(std::count(words.begin(), words.end(), kind.word), 1) << setting->name;
    }
  }
}

}  // namespace
}  // namespace lkao::method
