// The example that moves a mesh: it draws what it should, and says how near it is to the query.
#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/program.h"
#include "image/image.h"

namespace lkao::test {
namespace {

class MovingMesh : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    // llvmpipe draws in the calling thread: LeakSanitizer cannot stop its own ones at the end of the process.
    setenv("LP_NUM_THREADS", "0", 0);
  }

  // False, and the test is skipped, where EGL offers no software device.
  bool draw(const Arguments& more) {
    Arguments arguments = {"--gl", "software", "--rays", "64"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    result_ = run_program(arguments);
    return result_.err.find("EGL offers no software device") == std::string::npos;
  }

  ProgramResult result_;
};

#define LKAO_DRAW_OR_SKIP(...) \
  if (!draw({__VA_ARGS__})) GTEST_SKIP() << "the example is NOT tested on this machine: " << result_.err

double number_after(const std::string& text, const std::string& words) {
  const std::size_t place = text.find(words);
  return place == std::string::npos ? -1 : std::atof(text.c_str() + place + words.size());
}

TEST_F(MovingMesh, DrawsFramesThatMove) {
  LKAO_DRAW_OR_SKIP("--frames", "3", "--size", "97x61", "--output", path("frames"));
  ASSERT_EQ(result_.exit_code, 0) << result_.err;
  EXPECT_EQ(result_.err, "");
  std::set<std::vector<float>> pictures;
  for (const char* name : {"frames/frame-0000.png", "frames/frame-0001.png", "frames/frame-0002.png"}) {
    const image::Image picture = image::read_image(path(name));
    EXPECT_EQ(picture.width, 97);
    EXPECT_EQ(picture.height, 61);
    const auto [darkest, brightest] = std::minmax_element(picture.pixels.begin(), picture.pixels.end());
    EXPECT_GT(*brightest - *darkest, 0.4f) << name;
    pictures.insert(picture.pixels);
  }
  EXPECT_EQ(pictures.size(), 3u) << "frames are the same";
}

TEST_F(MovingMesh, IsNearTheQuery) {
  LKAO_DRAW_OR_SKIP("--frames", "1", "--size", "96x64");
  ASSERT_EQ(result_.exit_code, 0) << result_.err;
  EXPECT_GE(number_after(result_.out, "query: "), 60.0) << result_.out;
  EXPECT_LE(number_after(result_.out, "mean error "), 1.0 / 255) << result_.out;
}

TEST_F(MovingMesh, IsAsTheQueryAnswersIfExact) {
  LKAO_DRAW_OR_SKIP("--frames", "2", "--size", "96x64", "--masks", "exact");
  ASSERT_EQ(result_.exit_code, 0) << result_.err;
  EXPECT_THAT(result_.out, testing::ContainsRegex("occlusion: [0-9.]+ ms a frame \\(draw and resolve, median of 2\\)\n"
                                                  "all: [0-9.]+ ms a frame"));
  EXPECT_GE(number_after(result_.out, "query: "), 99.0) << result_.out;
  EXPECT_GE(number_after(result_.out, "% of "), 96 * 64 / 2) << result_.out;
  const double error = number_after(result_.out, "mean error ");
  EXPECT_GE(error, 0.0) << result_.out;
  EXPECT_LE(error, 1e-4) << result_.out;
}

TEST_F(MovingMesh, RadiusDarkens) {
  double mean[2] = {};
  for (int i = 0; i < 2; ++i) {
    LKAO_DRAW_OR_SKIP("--frames", "1", "--size", "64x48", "--output", path("."), "--radius", i == 0 ? "0.01" : "2");
    ASSERT_EQ(result_.exit_code, 0) << result_.err;
    const image::Image picture = image::read_image(path("frame-0000.png"));
    for (const float value : picture.pixels) mean[i] += value;
    mean[i] /= static_cast<double>(picture.pixels.size());
  }
  EXPECT_LT(mean[1], mean[0] - 0.05);
}

TEST_F(MovingMesh, NeedsTenLinesForLkao) {
  std::ifstream source(LKAO_MOVING_MESH_SOURCE);
  int marked_count = 0;
  for (std::string line; std::getline(source, line);) {
    const std::size_t mark = line.find(" // lkao");
    if (mark != std::string::npos && line.find_first_not_of(' ') < mark) ++marked_count;
  }
  EXPECT_GE(marked_count, 8);
  EXPECT_LE(marked_count, 10);
}

TEST_F(MovingMesh, BadInputIsOneLine) {
  LKAO_DRAW_OR_SKIP("--frames", "1", "--size", "8x8");
  write_file("file", "");
  const std::pair<Arguments, const char*> mistakes[] = {
      {{"--size", "640"}, "640"},      {{"--size", "0x48"}, "0x48"}, {{"--size", "64x48x"}, "64x48x"},
      {{"--frames", "0"}, "--frames"}, {{"--gl", "metal"}, "--gl"},  {{"--masks", "none"}, "--masks"},
      {{"--radius", "-1"}, "radius"},  {{"--rays", "1025"}, "1025"}, {{"--output", path("file")}, "file"},
      {{"--nonsense"}, "--nonsense"}};
  for (const auto& [arguments, named] : mistakes) {
    const ProgramResult result = run_program(arguments);
    EXPECT_EQ(result.exit_code, 2) << named;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, testing::StartsWith("moving_mesh: "));
    EXPECT_THAT(result.err, testing::HasSubstr(named));
  }
}

}  // namespace
}  // namespace lkao::test
