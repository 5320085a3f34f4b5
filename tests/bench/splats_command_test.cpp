// lkao-bench splats, on pictures so small that its milliseconds mean nothing.
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cli/program.h"

namespace lkao::test::splats_command_test {
namespace {

class SplatsCommand : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    setenv("LP_NUM_THREADS", "0", 0);  // as for RasterCommand
  }
};

TEST_F(SplatsCommand, ComparesEveryVariantWithRays) {
  const ProgramResult result = run_program({"splats", "--gl", "software", "--scenes", "box", "--radii", "1", "--width",
                                            "32", "--height", "24", "--csv", path("splats.csv")});
  if (result.err.find("EGL offers no") != std::string::npos) {
    GTEST_SKIP() << "OpenGL is NOT tested on this machine: " << result.err;
  }
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::istringstream file(read_file("splats.csv"));
  std::string line = "#";
  while (line.starts_with('#')) std::getline(file, line);
  EXPECT_EQ(line, "scene,radius,variant,milliseconds,far_fragments_a_pixel,mean_of_rays,mean_change,mae,rmse");
  std::map<std::string, std::vector<double>> rows;  // by variant: what follows it
  while (std::getline(file, line)) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    ASSERT_EQ(fields.size(), 9u) << line;
    for (std::size_t i = 3; i < fields.size(); ++i) rows[fields[2]].push_back(std::stod(fields[i]));
  }
  ASSERT_EQ(rows.size(), 7u);
  constexpr std::size_t kFill = 1, kOfRays = 2, kChange = 3, kRmse = 5;
  for (const auto& [variant, values] : rows) {
    EXPECT_EQ(values[kFill] > 0, !variant.starts_with("near")) << variant;
    EXPECT_GT(values[kOfRays], 0.1) << variant;
    EXPECT_GT(values[kRmse], 0) << variant;
  }
  EXPECT_GT(rows.at("both; as printed")[kChange], rows.at("both")[kChange]);
  EXPECT_LT(rows.at("both; pixel sphere 0.35")[kChange], rows.at("both")[kChange]);
}

TEST_F(SplatsCommand, BadInputIsOneLine) {
  for (const Arguments& more :
       std::vector<Arguments>{{"--scenes", "cornell"}, {"--radii", "-1"}, {"--turns", "0"}, {"--gl", "metal"}}) {
    Arguments arguments = {"splats", "--width", "8", "--height", "8"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_rejected(arguments, {});
  }
}

}  // namespace
}  // namespace lkao::test::splats_command_test
