// The example renderer: lkao in the place of its shadow rays changes the time, and nothing else.
#include <algorithm>
#include <cstddef>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/program.h"
#include "image/image.h"
#include "image/metrics.h"
#include "support/sanitized.h"

namespace lkao::test {
namespace {

constexpr int kWidth = tests::unless_sanitized(64, 32), kHeight = tests::unless_sanitized(48, 24);

class HostRenderer : public ProgramTest {
 protected:
  ProgramResult render(const std::string& scene, const std::string& ao, const Arguments& more = {}) const {
    Arguments arguments = {scene, "--ao", ao, "--rays", "64", "-o", path(ao + ".png")};
    arguments.insert(arguments.end(), {"--width", std::to_string(kWidth), "--height", std::to_string(kHeight)});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return expect_success(arguments);
  }
};

TEST_F(HostRenderer, MismatchesHardlyAnyRay) {
  const std::string out = render("builtin:atrium", "both").out;
  EXPECT_THAT(out, testing::ContainsRegex("embree +[0-9.]+ s\nlkao +[0-9.]+ s\nlkao is [0-9.]+ times as fast\n"));
  // Embree works in single precision: some rays in a million may differ.
  const std::string rays = std::to_string(64 * kWidth * kHeight);
  EXPECT_THAT(out, testing::ContainsRegex("; [0-2] of " + rays + " rays mismatched\n"));
}

// The scene in three places, and a light over the first.
TEST_F(HostRenderer, TakesInstancesAndALight) {
  for (const Arguments& more : {Arguments{}, {"--light", "0,8,0,1"}}) {
    Arguments arguments{"--copies", "3"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_THAT(render("builtin:atrium", "both", arguments).out,
                testing::ContainsRegex("; [0-9] of [1-9][0-9]* rays mismatched\n"));
    const image::Image copies = image::read_image(path("both.png"));
    const auto [darkest, brightest] = std::minmax_element(copies.pixels.begin(), copies.pixels.end());
    EXPECT_LT(*darkest, 0.5f);
    EXPECT_GT(*brightest, 0.8f);
  }
}

TEST_F(HostRenderer, ImagesAreTheSame) {
  for (const char* ao : {"embree", "lkao", "both"}) render("builtin:sphere", ao);
  EXPECT_EQ(read_file("lkao.png"), read_file("both.png"));
  const image::Image embree = image::read_image(path("embree.png")), lkao = image::read_image(path("lkao.png"));
  EXPECT_EQ(lkao.width, kWidth);
  EXPECT_EQ(lkao.height, kHeight);
  EXPECT_LT(image::compare(embree.pixels, lkao.pixels).mae, 1e-5);
  const auto [darkest, brightest] = std::minmax_element(lkao.pixels.begin(), lkao.pixels.end());
  EXPECT_LT(*darkest, 0.5f);
  EXPECT_GT(*brightest, 0.95f);
}

TEST_F(HostRenderer, NeedsFewerThanTenLinesForLkao) {
  std::ifstream source(LKAO_HOST_RENDERER_SOURCE);
  int marked_count = 0;
  for (std::string line; std::getline(source, line);) {
    const std::size_t mark = line.find(" // lkao");
    if (mark != std::string::npos && line.find_first_not_of(' ') < mark) ++marked_count;
  }
  EXPECT_GE(marked_count, 5);
  EXPECT_LT(marked_count, 10);
}

TEST_F(HostRenderer, BadInputIsOneLine) {
  const ProgramResult result = run_program({path("nowhere.ply")});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1);
  EXPECT_THAT(result.err, testing::HasSubstr("nowhere.ply"));
}

}  // namespace
}  // namespace lkao::test
