// lkao-bench screen, on pictures so small that its milliseconds mean nothing.
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cli/program.h"

namespace lkao::test::screen_command_test {
namespace {

using Row = std::map<std::string, std::string>;  // by column

class ScreenCommand : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    setenv("LP_NUM_THREADS", "0", 0);  // as for RasterCommand
  }

  static std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> all;
    std::istringstream stream(line + ",");
    for (std::string cell; std::getline(stream, cell, ',');) all.push_back(cell);
    return all;
  }

  std::vector<Row> rows_of(const std::string& file) const {
    std::istringstream lines(read_file(file));
    std::string line = "#";
    while (line.starts_with('#')) std::getline(lines, line);
    const std::vector<std::string> columns = cells(line);
    std::vector<Row> rows;
    while (std::getline(lines, line)) {
      const std::vector<std::string> values = cells(line);
      EXPECT_EQ(values.size(), columns.size()) << line;
      Row& row = rows.emplace_back();
      for (std::size_t i = 0; i < values.size(); ++i) row[columns[i]] = values[i];
    }
    return rows;
  }
};

TEST_F(ScreenCommand, TellsTheEstimatorFromTheMethod) {
  const ProgramResult result =
      run_program({"screen", "--gl", "software", "--scenes", "box", "--radii", "1", "--methods", "alchemy,vao",
                   "--width", "24", "--height", "18", "--csv", path("screen.csv")});
  if (result.err.find("EGL offers no") != std::string::npos) {
    GTEST_SKIP() << "OpenGL is NOT tested on this machine: " << result.err;
  }
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::map<std::string, std::vector<double>> curves;  // by method: errors of ever more samples
  std::map<std::string, int> error_rows;
  for (const Row& row : rows_of("screen.csv")) {
    const std::string &method = row.at("method"), &variant = row.at("variant");
    const double estimator = std::stod(row.at("estimator_rmse"));
    EXPECT_GT(std::stod(row.at("rmse")), 0) << method << ' ' << variant;
    // A factor that was found by least squares is no worse than none.
    EXPECT_LE(std::stod(row.at("best_rmse")), std::stod(row.at("rmse")) + 1e-6) << method << ' ' << variant;
    if (row.at("study") == "samples") {
      curves[method].push_back(estimator);
    } else {
      EXPECT_EQ(estimator == 0, variant == "converged") << method << ' ' << variant;
      EXPECT_EQ(row.at("culled_share").empty(), method != "vao") << variant;
      ++error_rows[method];
    }
  }
  EXPECT_EQ(error_rows["alchemy"], 7);
  EXPECT_EQ(error_rows["vao"], 8);
  ASSERT_EQ(curves.size(), 2u);
  for (const auto& [method, errors] : curves) EXPECT_LT(errors.back(), 0.4 * errors.front()) << method;
}

TEST_F(ScreenCommand, BadInputIsOneLine) {
  for (const Arguments& more : std::vector<Arguments>{
           {"--scenes", "cornell"}, {"--radii", "-1"}, {"--methods", "raster"}, {"--studies", "speed"}}) {
    Arguments arguments = {"screen", "--width", "8", "--height", "8"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_rejected(arguments, {});
  }
}

}  // namespace
}  // namespace lkao::test::screen_command_test
