// lkao-bench shadows, on scenes so small that its speeds mean nothing.
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/program.h"
#include "lkao/isa.h"

namespace lkao::test::shadows_command_test {
namespace {

class ShadowsCommand : public ProgramTest {
 protected:
  using ShadowRow = std::map<std::string, std::string>;

  // Rows by the names of their columns.
  std::vector<ShadowRow> measure_shadows(const Arguments& more) {
    Arguments arguments = {"shadows", "--tiles", "1", "--rounds", "1", "--csv", path("shadows.csv")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_success(arguments);
    std::istringstream stream(read_file("shadows.csv"));
    std::vector<std::string> names;
    std::vector<ShadowRow> rows;
    for (std::string line; std::getline(stream, line);) {
      if (line.starts_with('#')) continue;
      std::vector<std::string> fields;
      std::istringstream fields_stream(line);
      for (std::string field; std::getline(fields_stream, field, ',');) fields.push_back(field);
      if (names.empty()) {
        names = fields;
        continue;
      }
      EXPECT_EQ(fields.size(), names.size()) << line;
      ShadowRow row;
      for (std::size_t i = 0; i < names.size(); ++i) row[names[i]] = fields.at(i);
      rows.push_back(row);
    }
    return rows;
  }
};

TEST_F(ShadowsCommand, MeasuresEveryMethodUnderEveryLight) {
  const std::string isa = available_isas().back();
  const std::vector<ShadowRow> rows =
      measure_shadows({"--scenes", "atrium", "--samples", "64", "--light-radius", "3", "--isa", isa});
  constexpr std::size_t kMethodCount = 2 + 10;  // lkao's, and the modes of Embree
  ASSERT_EQ(rows.size(), 2 * kMethodCount);
  std::set<std::string> lights, methods;
  for (const ShadowRow& row : rows) {
    lights.insert(row.at("light"));
    methods.insert(row.at("method"));
    EXPECT_EQ(row.at("isa"), isa);
    EXPECT_GT(std::stod(row.at("mrays_per_second")), 0);
    EXPECT_LE(std::stod(row.at("ray_mismatch_rate")), 1e-3);
    EXPECT_LE(std::stod(row.at("visibility_mae")), 1e-4);
    EXPECT_LE(std::stod(row.at("lit_share")) + std::stod(row.at("umbra_share")), 1);
    if (row.at("method") != row.at("best_embree_mode")) continue;
    EXPECT_EQ(row.at("ratio_best"), "1");
  }
  EXPECT_EQ(lights, (std::set<std::string>{"disc", "sphere"}));
  EXPECT_EQ(methods.size(), kMethodCount);
}

TEST_F(ShadowsCommand, NamesBadOptions) {
  const auto refuse = [&](const Arguments& more, const std::string& word) {
    Arguments arguments = {"shadows", "--scenes", "wall"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_rejected(arguments, {word});
  };
  refuse({"--samples", "0"}, "--samples must be from 1 to 1024, not 0");
  refuse({"--light-radius", "0"}, "--light-radius must be above 0 and at most 100, not 0");
  refuse({"--isa", "mmx"}, "mmx");
}

}  // namespace
}  // namespace lkao::test::shadows_command_test
