// lkao-bench refit, on a small mesh.
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/program.h"

namespace lkao::test::refit_command_test {
namespace {

class RefitCommand : public ProgramTest {};

TEST_F(RefitCommand, MeasuresEveryDeformation) {
  expect_success(
      {"refit", "--scenes", "sphere", "--rounds", "1", "--width", "16", "--height", "12", "--csv", path("refit.csv")});
  std::istringstream file(read_file("refit.csv"));
  std::string line = "#";
  while (line.starts_with('#')) std::getline(file, line);
  EXPECT_EQ(line,
            "scene,triangles,spatial_splits,deformation,strength,radius,build_seconds,refit_seconds,time_ratio,growth,"
            "cost_ratio,built_query_us,refitted_query_us,query_ratio,mismatched_rays,rays");
  int count = 0;
  while (std::getline(file, line)) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    ASSERT_EQ(fields.size(), 16u) << line;
    EXPECT_GT(std::stod(fields[8]), 0) << line;
    EXPECT_GT(std::stod(fields[9]), 0.5) << line;
    EXPECT_EQ(fields[14], "0") << line;
    EXPECT_GT(std::stoi(fields[15]), 0) << line;
    ++count;
  }
  EXPECT_EQ(count, 3 * 4 * 2 * 2);  // deformations, strengths, splits, radii
}

TEST_F(RefitCommand, BadInputIsOneLine) {
  expect_rejected({"refit", "--scenes", "cornell"}, {"cornell"});
  expect_rejected({"refit", "--deformations", "melt"}, {"melt"});
}

}  // namespace
}  // namespace lkao::test::refit_command_test
