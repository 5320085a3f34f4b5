#include "scene/formats/gltf/json_text.h"

#include <gmock/gmock.h>

namespace lkao::scene::gltf {
namespace {

using testing::ElementsAre;

TEST(JsonText, StaysAsItIsWhereNothingChanges) {
  const std::string text =
      " {\t\"a\" : [ 1.50e+0 , -0, 12345678901234567890123 ],\r\n\"\\u0062\":{ }, \"c\\\"}\":null } ";
  EXPECT_EQ(JsonText(text).changed(), text);
  const JsonText marked("\xef\xbb\xbf" + text);
  EXPECT_TRUE(marked.find(marked.root(), "b"));
  EXPECT_EQ(marked.changed(), "\xef\xbb\xbf" + text);
}

TEST(JsonText, FindsMembersAndElements) {
  const JsonText text(R"({"a":[{},"x]}",[[1],2],true],"\u0062":3,"b}\"":{"a":4}, "a b":-1e5})");
  const JsonText::Place list = *text.find(text.root(), "a");
  ASSERT_EQ(text.size(list), 4u);
  EXPECT_EQ(text.text_of(text.element(list, 0)), "{}");
  EXPECT_EQ(text.text_of(text.element(list, 1)), R"("x]}")");
  EXPECT_EQ(text.text_of(text.element(list, 2)), "[[1],2]");
  EXPECT_EQ(text.text_of(text.element(list, 3)), "true");
  EXPECT_EQ(text.text_of(*text.find(text.root(), "b")), "3");
  EXPECT_EQ(text.text_of(*text.find(*text.find(text.root(), "b}\""), "a")), "4");
  EXPECT_EQ(text.text_of(*text.find(text.root(), "a b")), "-1e5");
  EXPECT_FALSE(text.find(text.root(), "c"));
  EXPECT_THAT(text.members_but(text.root(), {"a", "b"}), ElementsAre(R"("b}\"":{"a":4})", R"("a b":-1e5)"));
}

TEST(JsonText, OfMembersWithOneKeyTheLastCounts) {
  JsonText text(R"({"a":1,"a":2})");
  EXPECT_EQ(text.text_of(*text.find(text.root(), "a")), "2");
  text.set(text.root(), "a", "3");
  EXPECT_EQ(text.changed(), R"({"a":1,"a":3})");
}

TEST(JsonText, ChangesAtManyPlaces) {
  JsonText text(R"({ "list": [1, 2 ], "empty": [ ], "object": {"x": {"y": 0} }, "old": [[]] })");
  const JsonText::Place object = *text.find(text.root(), "object");
  text.append(*text.find(text.root(), "list"), "3");
  text.append(*text.find(text.root(), "list"), "[4]");
  text.append(*text.find(text.root(), "empty"), "5");
  text.append(*text.find(text.root(), "empty"), "6");
  text.set(*text.find(object, "x"), "y", "7");
  text.set(*text.find(object, "x"), "z", "8");
  text.set(object, "n\"", "9");
  text.set(text.root(), "last", "{}");
  text.replace(*text.find(text.root(), "old"), joined({"\"a\":1", "\"b\":2"}));
  EXPECT_EQ(
      text.changed(),
      R"({ "list": [1, 2,3,[4] ], "empty": [5,6 ], "object": {"x": {"y": 7,"z":8},"n\"":9 }, "old": {"a":1,"b":2},"last":{} })");
}

TEST(JsonText, GoesIntoAnyDepth) {
  const std::string deep = std::string(100000, '[') + std::string(100000, ']');
  JsonText text("{\"deep\":" + deep + ",\"a\":1}");
  EXPECT_EQ(text.text_of(*text.find(text.root(), "deep")), deep);
  text.set(text.root(), "a", "2");
  EXPECT_EQ(text.changed(), "{\"deep\":" + deep + ",\"a\":2}");
}

TEST(JsonText, SpellsStrings) {
  EXPECT_EQ(to_json_string("a\"\\\n\xc3\xa4"), "\"a\\\"\\\\\\n\xc3\xa4\"");
  EXPECT_EQ(to_json_string("\xff"), "\"\xef\xbf\xbd\"");
}

}  // namespace
}  // namespace lkao::scene::gltf
