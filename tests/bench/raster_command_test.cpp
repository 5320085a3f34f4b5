// lkao-bench raster, on pictures so small that its milliseconds mean nothing.
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cli/program.h"

namespace lkao::test::raster_command_test {
namespace {

struct Row {
  std::string scene, radius, study, variant;
  double milliseconds, mrays_per_second, mismatch_rate, mae, equal_share, drawn, survivors;
};

class RasterCommand : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    // llvmpipe draws in the calling thread: LeakSanitizer cannot stop its own ones at the end of the process.
    setenv("LP_NUM_THREADS", "0", 0);
  }

  // Empty where EGL offers no software device; the reason is then in `skip_reason_`.
  std::vector<Row> measure(const Arguments& more) {
    Arguments arguments = {"raster",   "--gl", "software", "--rounds",        "1", "--width", "32",
                           "--height", "24",   "--csv",    path("raster.csv")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = run_program(arguments);
    if (result.err.find("EGL offers no") != std::string::npos) {
      skip_reason_ = result.err;
      return {};
    }
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::istringstream file(read_file("raster.csv"));
    std::string line = "#";
    std::getline(file, line);
    EXPECT_TRUE(line.starts_with("# processor: ")) << line;
    while (line.starts_with('#')) std::getline(file, line);
    EXPECT_EQ(line,
              "scene,radius,study,variant,milliseconds,mrays_per_second,ray_mismatch_rate,mae,rmse,max_error,"
              "equal_8bit_share,drawn_fragments,surviving_fragments,masks");
    std::vector<Row> rows;
    while (std::getline(file, line)) rows.push_back(parse(line));
    return rows;
  }

  std::string skip_reason_;

 private:
  static Row parse(const std::string& line) {
    std::vector<std::string> f;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) f.push_back(field);
    EXPECT_EQ(f.size(), 14u) << line;
    const auto number = [&](std::size_t i) { return std::stod(f.at(i)); };
    return {f.at(0),   f.at(1),   f.at(2),    f.at(3),    number(4), number(5),
            number(6), number(7), number(10), number(11), number(12)};
  }
};

#define LKAO_MEASURE_OR_SKIP(...)                       \
  const std::vector<Row> rows = measure({__VA_ARGS__}); \
  if (!skip_reason_.empty()) GTEST_SKIP() << "OpenGL is NOT tested on this machine: " << skip_reason_

TEST_F(RasterCommand, ComparesEveryMethodWithTheQuery) {
  LKAO_MEASURE_OR_SKIP("--scenes", "wall", "--radii", "0.3,1", "--studies", "methods");
  ASSERT_EQ(rows.size(), 2u * 4);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].scene, "wall");
    EXPECT_EQ(rows[i].radius, i < 4 ? "0.3" : "1");
    EXPECT_GT(rows[i].milliseconds, 0);
    EXPECT_GT(rows[i].mrays_per_second, 0);
  }
  for (std::size_t i : {1u, 2u, 3u, 5u, 6u, 7u}) {
    EXPECT_LE(rows[i].mismatch_rate, 1e-4) << rows[i].variant;
    EXPECT_GE(rows[i].equal_share, 0.99) << rows[i].variant;
  }
  EXPECT_GT(rows[4].mismatch_rate, 0) << "nearest cells err somewhere";
  EXPECT_LT(rows[4].mae, 0.02);
}

TEST_F(RasterCommand, CullsAddUp) {
  LKAO_MEASURE_OR_SKIP("--scenes", "sphere", "--studies", "culls", "--radii", "0.5", "--samples", "64");
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows[0].survivors, rows[0].drawn);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].drawn, rows[0].drawn) << "culls change no shape";
    EXPECT_LE(rows[i].survivors, rows[i - 1].survivors) << rows[i].variant;
  }
  EXPECT_LT(rows[5].survivors, 0.7 * rows[0].survivors);
}

TEST_F(RasterCommand, BadInputIsOneLine) {
  for (const Arguments& more : std::vector<Arguments>{{"--scenes", "cornell"},
                                                      {"--views", path("nowhere.json")},
                                                      {"--samples", "1025"},
                                                      {"--studies", "speed"},
                                                      {"--radii", "-1"},
                                                      {"--gl", "metal"}}) {
    Arguments arguments = {"raster", "--width", "8", "--height", "8"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_rejected(arguments, {});
  }
}

}  // namespace
}  // namespace lkao::test::raster_command_test
