// lkao-bench build, on meshes so small that its seconds mean nothing.
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/program.h"

namespace lkao::test::build_command_test {
namespace {

struct Row {
  std::string scene, threads, method, time_ratio, memory_ratio;
  double triangle_count, seconds, bytes_per_triangle, mesh_bytes_per_triangle;
};

class BuildCommand : public ProgramTest {
 protected:
  std::vector<Row> measure(const Arguments& more) {
    Arguments arguments = {"build", "--rounds", "1", "--csv", path("build.csv")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_THAT(expect_success(arguments).out, testing::HasSubstr("Peak memory"));
    std::istringstream file(read_file("build.csv"));
    std::string line = "#";
    while (line.starts_with('#')) std::getline(file, line);  // what it was measured on
    EXPECT_EQ(
        line,
        "scene,triangles,threads,method,seconds,cpu_seconds,bytes_per_triangle,mesh_bytes_per_triangle,time_ratio,"
        "cpu_time_ratio,memory_ratio,nodes,references,sah_nodes,sah_leaves,query_us");
    std::vector<Row> rows;
    while (std::getline(file, line)) rows.push_back(parse(line));
    return rows;
  }

 private:
  static Row parse(const std::string& line) {
    std::vector<std::string> f;
    std::istringstream stream(line + ",");
    for (std::string field; std::getline(stream, field, ',');) f.push_back(field);
    EXPECT_EQ(f.size(), 16u) << line;
    return {f.at(0),
            f.at(2),
            f.at(3),
            f.at(8),
            f.at(10),
            std::stod(f.at(1)),
            std::stod(f.at(4)),
            std::stod(f.at(6)),
            std::stod(f.at(7))};
  }
};

TEST_F(BuildCommand, MeasuresEveryMethodOnEveryNumberOfThreads) {
  const std::vector<Row> rows = measure({"--scenes", "wall,sphere", "--threads", "1,2"});
  ASSERT_EQ(rows.size(), 2u * 2 * 4);
  const char* methods[] = {"lkao", "lkao_no_splits", "embree_high", "embree_medium"};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row &row = rows[i], &lkao = rows[i / 4 * 4];
    EXPECT_EQ(row.scene, i < 8 ? "wall" : "sphere");
    EXPECT_EQ(row.threads, i / 4 % 2 == 0 ? "1" : "2");
    EXPECT_EQ(row.method, methods[i % 4]);
    EXPECT_GT(row.seconds, 0);
    EXPECT_NEAR(std::stod(row.time_ratio), lkao.seconds / row.seconds, 1e-3 * std::stod(row.time_ratio));
    EXPECT_NEAR(std::stod(row.memory_ratio), lkao.bytes_per_triangle / row.bytes_per_triangle, 1e-3);
    // At least 12 bytes of indices a triangle, and something for the hierarchy.
    EXPECT_GT(row.mesh_bytes_per_triangle, 12);
    EXPECT_GT(row.bytes_per_triangle, row.mesh_bytes_per_triangle + 12);
  }
}

TEST_F(BuildCommand, MethodsAreMeasuredAlone) {
  const std::vector<Row> rows = measure({"--hairball", "5000,20000", "--methods", "embree_high", "--threads", "1"});
  ASSERT_EQ(rows.size(), 2u);
  for (const Row& row : rows) {
    EXPECT_EQ(row.scene, "hairball");
    EXPECT_EQ(row.method, "embree_high");
    EXPECT_EQ(row.time_ratio + row.memory_ratio, "");
  }
  EXPECT_NEAR(rows[0].triangle_count, 5000, 240);
  EXPECT_NEAR(rows[1].triangle_count, 20'000, 240);
}

TEST_F(BuildCommand, HierarchiesThatReferHaveNoCopyOfTheMesh) {
  const std::vector<Row> rows = measure({"--scenes", "wall", "--methods", "lkao,lkao_refer", "--threads", "1"});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1].mesh_bytes_per_triangle, 0);
  EXPECT_NEAR(rows[1].bytes_per_triangle, rows[0].bytes_per_triangle - rows[0].mesh_bytes_per_triangle, 0.1);
}

// The limit that the project sets itself, where spatial splits add most.
TEST_F(BuildCommand, MemoryIsAtMostTwiceEmbrees) {
  const std::vector<Row> rows = measure({"--hairball", "20000", "--threads", "2"});
  for (const Row& row : rows) EXPECT_LE(std::stod(row.memory_ratio), 2) << row.method;
}

TEST_F(BuildCommand, BadInputIsOneLine) {
  for (const Arguments& more : std::vector<Arguments>{{"--scenes", "cornell"},
                                                      {"--views", path("nowhere.json")},
                                                      {"--threads", "0"},
                                                      {"--methods", "optix"},
                                                      {"--hairball", "0"}}) {
    Arguments arguments = {"build", "--rounds", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_rejected(arguments, {});
  }
}

}  // namespace
}  // namespace lkao::test::build_command_test
