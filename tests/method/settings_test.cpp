#include "method/settings.h"

#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>
#include <CLI/CLI.hpp>

#include "method/list.h"
#include "method/setting_options.h"

namespace lkao::method {
namespace {

enum class Side { left, right };
constexpr Word<Side> kSideWords[] = {{"left", Side::left}, {"right", Side::right}};

const Setting kSide = word_setting("side", "Which side", kSideWords, Side::right);
const Setting kCount{.name = "count", .help = "How many", .values = Range{1, 1e6, true}, .default_text = "3"};
const Setting kShare{.name = "share", .help = "How much", .values = Range{0, 1}, .default_text = "0.5"};

TEST(Settings, HaveDefaults) {
  const Settings settings;
  EXPECT_EQ(settings.value(kSide, kSideWords), Side::right);
  EXPECT_EQ(settings.number(kShare), 0.5);
  EXPECT_TRUE(settings.chosen().empty());
}

TEST(Settings, RememberWhatIsChosen) {
  Settings settings;
  settings.set(kSide, "left");
  settings.set(kShare, "1");
  settings.set(kShare, "0.25");
  EXPECT_EQ(settings.value(kSide, kSideWords), Side::left);
  EXPECT_EQ(settings.number(kShare), 0.25);
  EXPECT_EQ(settings.chosen().size(), 2u);
}

TEST(Settings, TakeOnlyTheirValues) {
  Settings settings;
  for (const char* text : {"", "middle", "0"}) EXPECT_THROW(settings.set(kSide, text), std::invalid_argument) << text;
  for (const char* text : {"", "-0.1", "1.1", "nan", "half", "1 "}) {
    EXPECT_THROW(settings.set(kShare, text), std::invalid_argument) << text;
  }
  for (const char* text : {"0", "2.5", "1e7"}) EXPECT_THROW(settings.set(kCount, text), std::invalid_argument) << text;
  EXPECT_NO_THROW(kCount.check("1e3"));
  EXPECT_TRUE(settings.chosen().empty());
  EXPECT_EQ(kSide.values_text(), "left|right");
  EXPECT_EQ(kShare.values_text(), "0..1");
}

TEST(Settings, AreOptionsOfACommandLine) {
  Settings settings;
  CLI::App app;
  add_setting_option(app, settings, kShare);
  app.parse("--share 0.75");
  EXPECT_EQ(settings.number(kShare), 0.75);
  EXPECT_NE(app.help().find("How much (default: 0.5)"), std::string::npos) << app.help();
  try {
    app.parse("--share 2");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "--share: expected a number from 0 to 1, got '2'");
  }
}

TEST(Settings, OfSeveralMethodsAreOptionsOnce) {
  MethodKind a{.settings = {&kSide, &kShare}}, b{.settings = {&kShare}};
  Settings settings;
  CLI::App app;
  add_setting_options(app, settings, {&a, &b});  // throws for an option that is there
  app.parse("--share 0.75 --side left");
  EXPECT_EQ(settings.chosen().size(), 2u);
}

}  // namespace
}  // namespace lkao::method
