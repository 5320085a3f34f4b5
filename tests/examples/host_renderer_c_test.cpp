// The example renderer in C, as a user runs it.
#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cli/program.h"

namespace lkao::test {
namespace {

class HostRendererInC : public ProgramTest {
 protected:
  // The pixels, without what a PGM begins with.
  std::string render(const Arguments& tile) const {
    const std::string file = path("courtyard.pgm"), head = "P5\n160 120\n255\n";
    Arguments arguments{file};
    arguments.insert(arguments.end(), tile.begin(), tile.end());
    expect_success(arguments);
    const std::string bytes = read_file("courtyard.pgm");
    EXPECT_EQ(bytes.substr(0, head.size()), head);
    EXPECT_EQ(bytes.size(), head.size() + 160 * 120);
    return bytes.substr(head.size());
  }
};

// Of the pixel in column x and row y.
int grey(const std::string& pixels, int x, int y) {
  return static_cast<unsigned char>(pixels.at(static_cast<std::size_t>(160 * y + x)));
}

TEST_F(HostRendererInC, ShowsTheCourtyard) {
  const std::string pixels = render({});
  EXPECT_EQ(grey(pixels, 5, 5), 0) << "the sky is black";
  EXPECT_GT(grey(pixels, 110, 100), 245) << "the open ground is white";
  EXPECT_GT(grey(pixels, 80, 52), 245) << "so is the crate's top";
  EXPECT_LT(grey(pixels, 73, 43), 100) << "the corner of the walls and the ground is dark";
}

TEST_F(HostRendererInC, TilesOfAnySizeShowTheSame) {
  const std::string pixels = render({"16"});
  EXPECT_EQ(render({"16"}), pixels);
  for (const char* tile : {"7", "64"}) {
    const std::string other = render({tile});
    double squares = 0;
    for (int i = 0; i < 160 * 120; ++i) {
      const int difference = grey(pixels, i % 160, i / 160) - grey(other, i % 160, i / 160);
      squares += difference * difference;
    }
    // Turned rays, of 128 a pixel.
    EXPECT_LT(squares / (160 * 120), 9) << tile;
  }
}

TEST_F(HostRendererInC, BadInputIsOneLine) {
  for (const Arguments& arguments : {Arguments{}, Arguments{path("a.pgm"), "65"}, Arguments{path("nowhere/a.pgm")}}) {
    const ProgramResult result = run_program(arguments);
    EXPECT_NE(result.exit_code, 0);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1);
    EXPECT_TRUE(files().empty());
  }
}

}  // namespace
}  // namespace lkao::test
