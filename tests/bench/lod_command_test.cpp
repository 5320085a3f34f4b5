// lkao-bench lod, on pictures so small that its milliseconds mean nothing.
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/program.h"

namespace lkao::test::lod_command_test {
namespace {

struct Row {
  std::string method;
  double k, epsilon, mismatch_rate, rmse;
};

class LodCommand : public ProgramTest {
 protected:
  std::vector<Row> measure(const Arguments& more) {
    Arguments arguments = {"lod", "--width", "24", "--height", "18", "--scenes", "sphere", "--csv", path("lod.csv")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_success(arguments);
    std::istringstream file(read_file("lod.csv"));
    std::string line = "#";
    while (line.starts_with('#')) std::getline(file, line);  // what it was measured on
    EXPECT_EQ(line,
              "scene,radius,method,k,epsilon,triangles,milliseconds,speedup,ray_mismatch_rate,mae,rmse,"
              "equal_8bit_share,mean_change");
    std::vector<Row> rows;
    while (std::getline(file, line)) {
      std::vector<std::string> f;
      std::istringstream stream(line);
      for (std::string field; std::getline(stream, field, ',');) f.push_back(field);
      EXPECT_EQ(f.size(), 13u) << line;
      rows.push_back({f.at(2), std::stod(f.at(3)), std::stod(f.at(4)), std::stod(f.at(8)), std::stod(f.at(10))});
    }
    return rows;
  }
};

// The first row is the scene itself; then the finer epsilon with each k, then the automatic one.
TEST_F(LodCommand, ComparesEveryVariantWithTheScene) {
  const std::vector<Row> rows = measure({"--methods", "bvh", "--k", "2,1000000"});
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(rows[0].k, 0);
  for (std::size_t i = 1; i < 5; ++i) {
    EXPECT_EQ(rows[i].method, "bvh");
    EXPECT_EQ(rows[i].k, i % 2 == 1 ? 2 : 1e6);
  }
  EXPECT_NEAR(rows[3].epsilon, 3 * rows[1].epsilon, 1e-5 * rows[3].epsilon);
  EXPECT_GT(rows[3].mismatch_rate, 0);
  // Levels so far away that no ray reaches them.
  for (const std::size_t i : {0u, 2u, 4u}) {
    EXPECT_EQ(rows[i].mismatch_rate, 0) << i;
    EXPECT_EQ(rows[i].rmse, 0) << i;
  }
}

}  // namespace
}  // namespace lkao::test::lod_command_test
