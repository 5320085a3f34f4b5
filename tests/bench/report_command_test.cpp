// lkao-bench report, on pictures so small that its milliseconds mean nothing; report_page_test.py looks at the page.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/report/errors.h"
#include "cli/program.h"

namespace lkao::test::report_command_test {
namespace {

using bench::errors_of, bench::PictureErrors;

TEST(PictureErrors, AreThoseOfAPictureThatIsKnown) {
  const float none = std::numeric_limits<float>::quiet_NaN();
  // Off by 0, 1/100, ..., 99/100, in no order, the odd ones too light; and a pixel without a receiver.
  std::vector<float> picture, right;
  for (int i = 0; i < 100; ++i) {
    const int off = 37 * i % 100;
    picture.push_back(off % 2 == 0 ? static_cast<float>(off) / 100 : 0.0f);
    right.push_back(off % 2 == 0 ? 0.0f : static_cast<float>(off) / 100);
  }
  picture.push_back(none);
  right.push_back(none);
  const PictureErrors errors = errors_of(picture, right, 101, 1);
  EXPECT_EQ(errors.pixel_count, 100u);
  EXPECT_NEAR(errors.bias, (24.5 - 25.0) / 100, 1e-6);
  EXPECT_NEAR(errors.mae, 0.495, 1e-6);
  EXPECT_NEAR(errors.rmse, std::sqrt(328350.0) / 1000, 1e-6);
  EXPECT_NEAR(errors.median, 0.49, 1e-6);
  EXPECT_NEAR(errors.percentile_95, 0.94, 1e-6);
  EXPECT_NEAR(errors.percentile_99, 0.98, 1e-6);
  EXPECT_NEAR(errors.largest, 0.99, 1e-6);
  EXPECT_NEAR(errors.psnr, -20 * std::log10(errors.rmse), 1e-6);
  EXPECT_EQ(errors.equal_8bit_share, 0.01);
  EXPECT_GT(errors.log_error, 0);
}

TEST(PictureErrors, OfEqualPicturesAreNone) {
  const std::vector<float> picture = {0.25f, 0.5f, 1, 0};
  const PictureErrors errors = errors_of(picture, picture, 2, 2);
  EXPECT_EQ(errors.largest, 0);
  EXPECT_EQ(errors.percentile_99, 0);
  EXPECT_EQ(errors.log_error, 0);
  EXPECT_EQ(errors.equal_8bit_share, 1);
}

class ReportCommand : public ProgramTest {
 protected:
  static Arguments report_to(const std::string& folder, const std::string& methods) {
    return {"report", "-o", folder, "--quick", "--scenes", "box", "--methods", methods, "--rounds", "1"};
  }

  // Rows of the CSV by contestant, cells by column; commas within quotes divide nothing.
  std::map<std::string, std::map<std::string, std::string>> rows_of(const std::string& file) const {
    std::istringstream lines(read_file(file));
    std::string line = "#";
    while (line.starts_with('#')) std::getline(lines, line);
    const std::vector<std::string> columns = cells(line);
    std::map<std::string, std::map<std::string, std::string>> rows;
    while (std::getline(lines, line)) {
      const std::vector<std::string> values = cells(line);
      EXPECT_EQ(values.size(), columns.size()) << line;
      std::map<std::string, std::string> row;
      for (std::size_t i = 0; i < values.size(); ++i) row[columns[i]] = values[i];
      rows[row.at("contestant")] = row;
    }
    return rows;
  }

 private:
  static std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> all(1);
    bool is_quoted = false;
    for (const char c : line) {
      if (c == '"')
        is_quoted = !is_quoted;
      else if (c == ',' && !is_quoted)
        all.emplace_back();
      else
        all.back() += c;
    }
    return all;
  }
};

TEST_F(ReportCommand, RowsAgreeWithThemselves) {
  const ProgramResult result = run_program(report_to(path("report"), "query,patterns,tables,levels"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto rows = rows_of("report/report.csv");
  ASSERT_GE(rows.size(), 8u);
  const auto number = [&](const std::string& contestant, const char* column) {
    return std::stod(rows.at(contestant).at(column));
  };
  for (const auto& [contestant, row] : rows) {
    EXPECT_GT(number(contestant, "milliseconds"), 0) << contestant;
    EXPECT_LE(std::fabs(number(contestant, "bias")), number(contestant, "mae")) << contestant;
    EXPECT_LE(number(contestant, "mae"), number(contestant, "rmse")) << contestant;
    EXPECT_LE(number(contestant, "median"), number(contestant, "percentile_95")) << contestant;
    EXPECT_LE(number(contestant, "percentile_95"), number(contestant, "percentile_99")) << contestant;
    EXPECT_LE(number(contestant, "percentile_99"), number(contestant, "largest")) << contestant;
    EXPECT_LT(number(contestant, "noise_floor_rmse"), 0.002) << contestant;
  }
  // The query has Embree's bits, and errs less with more rays; tables and random directions err more.
  EXPECT_EQ(number("query, 128 rays", "mismatch_rate"), 0);
  EXPECT_LT(number("query, 1024 rays", "rmse"), 0.5 * number("query, 64 rays", "rmse"));
  EXPECT_GT(number("query, 64 rays, random", "rmse"), 1.5 * number("query, 64 rays", "rmse"));
  EXPECT_GT(number("table nearest, 64^3, 128 rays", "mismatch_rate"), 0);
}

TEST_F(ReportCommand, WhatHasNoTimeIsLeftOutAndToldOf) {
  Arguments arguments = report_to(path("report"), "query,tables");
  arguments.insert(arguments.end(), {"--minutes", "0.001"});
  const ProgramResult result = run_program(arguments);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  auto rows = rows_of("report/report.csv");
  int left_out = 0;
  for (const auto& [contestant, row] : rows) {
    EXPECT_EQ(row.at("milliseconds").empty(), !row.at("left_out").empty()) << contestant;
    left_out += row.at("left_out").empty() ? 0 : 1;
  }
  EXPECT_GT(left_out, 0);
  EXPECT_TRUE(rows.at("query, 16 rays").at("left_out").empty());  // the first is measured whatever there is
  // The same again decides nothing anew; with more time they have theirs.
  EXPECT_EQ(run_program(arguments).out.find("left out"), std::string::npos);
  arguments.back() = "10";
  EXPECT_EQ(run_program(arguments).exit_code, 0);
  rows = rows_of("report/report.csv");
  for (const auto& [contestant, row] : rows) EXPECT_EQ(row.at("left_out"), "") << contestant;
}

// Estimates, the studies of papers, and falloffs of their own.
TEST_F(ReportCommand, AFullReportHasAllItsParts) {
  const ProgramResult result = run_program({"report", "-o", path("report"), "--scenes", "box", "--size", "32x24",
                                            "--rounds", "1", "--minutes", "10", "--methods", "raster,volumes"});
  if (result.err.find("without OpenGL") != std::string::npos) GTEST_SKIP() << "needs OpenGL";
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto rows = rows_of("report/report.csv");
  EXPECT_EQ(rows.at("volumes, delta 0.6").at("own_falloff"), "linear");
  EXPECT_LT(std::stod(rows.at("volumes, delta 0.6").at("own_falloff_rmse")),
            std::stod(rows.at("volumes, delta 0.6").at("rmse")));
  for (const auto& [contestant, row] : rows) EXPECT_EQ(row.at("left_out"), "") << contestant;
  const std::string page = read_file("report/report.html");
  for (const char* part :
       {"\"sweep\"", "\"culls\":{\"width\":32", "Table 2: what culling fragments saves", "Figure 10"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
}

TEST_F(ReportCommand, ADamagedRecordIsMeasuredAgain) {
  ASSERT_EQ(run_program(report_to(path("report"), "tables")).exit_code, 0);
  for (const auto& entry : std::filesystem::directory_iterator(path("report/measured"))) {
    const std::string name = entry.path().filename().string();
    if (name.find("table") == std::string::npos || entry.path().extension() != ".json") continue;
    std::ofstream(entry.path()) << "{\"program\": ";
  }
  const ProgramResult again = run_program(report_to(path("report"), "tables"));
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(again.out.find("RMSE"), std::string::npos) << again.out;
}

TEST_F(ReportCommand, BadInputIsOneLine) {
  write_file("file", "");
  const Arguments quick = {"--quick", "--scenes", "box"};
  for (const Arguments& more : std::vector<Arguments>{{"-o", path("file")},
                                                      {"-o", path("a"), "--methods", "rays"},
                                                      {"-o", path("a"), "--size", "320"},
                                                      {"-o", path("a"), "--size", "0x8"},
                                                      {"-o", path("a"), "--size", "8x8x8"},
                                                      {"-o", path("a"), "--minutes", "-1"},
                                                      {"-o", path("a"), "--rounds", "0"},
                                                      {"-o", path("a"), "--views", path("none.json")},
                                                      {}}) {
    Arguments arguments = {"report"};
    arguments.insert(arguments.end(), quick.begin(), quick.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_rejected(arguments, {});
  }
}

}  // namespace
}  // namespace lkao::test::report_command_test
