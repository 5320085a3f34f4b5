// lkao-bench volumes, on pictures so small that its milliseconds mean nothing.
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cli/program.h"

namespace lkao::test::volumes_command_test {
namespace {

class VolumesCommand : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    setenv("LP_NUM_THREADS", "0", 0);  // as for RasterCommand
  }
};

TEST_F(VolumesCommand, ComparesWithRaysAndFits) {
  const ProgramResult result =
      run_program({"volumes", "--gl", "software", "--scenes", "wall", "--radii", "1", "--width", "32", "--height", "24",
                   "--turns", "1", "--studies", "deltas,clamps,back_ends", "--fit", "--csv", path("volumes.csv")});
  if (result.err.find("EGL offers no") != std::string::npos) {
    GTEST_SKIP() << "OpenGL is NOT tested on this machine: " << result.err;
  }
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("compensation: "), std::string::npos) << result.out;
  std::istringstream file(read_file("volumes.csv"));
  std::string line = "#";
  while (line.starts_with('#')) std::getline(file, line);
  EXPECT_EQ(line,
            "scene,triangles,radius,study,variant,milliseconds,fragments,fragments_inside,fragments_blended,mae,rmse,"
            "mean_change,log_error");
  std::map<std::string, std::vector<double>> rows;  // by variant: what follows it
  while (std::getline(file, line)) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    ASSERT_EQ(fields.size(), 13u) << line;
    for (std::size_t i = 5; i < fields.size(); ++i) rows[fields[4]].push_back(std::stod(fields[i]));
  }
  ASSERT_EQ(rows.size(), 7u + 2 + 4);
  constexpr std::size_t kFill = 1, kInside = 2, kBlended = 3, kChange = 6, kLogError = 7;
  for (const auto& [variant, values] : rows) {
    EXPECT_GT(values[kFill], values[kInside]) << variant;
    EXPECT_GT(values[kInside], values[kBlended]) << variant;
    EXPECT_GT(values[kBlended], 0) << variant;
    EXPECT_GT(values[kLogError], 0) << variant;
  }
  EXPECT_GT(rows.at("delta 1 of the radius")[kChange], rows.at("delta 0.4 of the radius")[kChange]);
  EXPECT_GT(rows.at("delta 1 of the radius")[kFill], rows.at("delta 0.4 of the radius")[kFill]);
  EXPECT_GT(rows.at("not clamped")[kFill], rows.at("clamped")[kFill]);
  EXPECT_EQ(rows.at("kept + vertex_pulling")[kLogError], rows.at("every_frame + geometry_shader")[kLogError]);
}

TEST_F(VolumesCommand, BadInputIsOneLine) {
  for (const Arguments& more : std::vector<Arguments>{
           {"--scenes", "cornell"}, {"--studies", "speed"}, {"--radii", "-1"}, {"--turns", "0"}, {"--gl", "metal"}}) {
    Arguments arguments = {"volumes", "--width", "8", "--height", "8"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_rejected(arguments, {});
  }
}

}  // namespace
}  // namespace lkao::test::volumes_command_test
