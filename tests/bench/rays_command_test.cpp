// lkao-bench rays, on scenes so small that its speeds mean nothing.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/program.h"
#include "lkao/isa.h"

namespace lkao::test {
namespace {

constexpr int kEmbreeModeCount = 10;

struct Row {
  std::string scene, radius, samples, isa, method, best_embree_mode;
  double mrays_per_second, best_embree_mrays, occluded1_mrays, ratio_best, ratio_occluded1, ray_mismatch_rate;
};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

class RaysCommand : public ProgramTest {
 protected:
  // Of the smallest run there is, but for what `more` adds.
  std::vector<Row> measure(const Arguments& more) {
    Arguments arguments = {"rays", "--tiles", "1", "--rounds", "1", "--csv", path("rays.csv")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const std::string table = expect_success(arguments).out;
    EXPECT_THAT(table, testing::HasSubstr("Geometric mean of"));
    EXPECT_THAT(table, testing::HasSubstr("Worst cell"));
    return read_rows();
  }

  std::vector<Row> read_rows() const {
    const std::vector<std::string> lines = split(read_file("rays.csv"), '\n');
    EXPECT_EQ(lines.at(0),
              "scene,radius,samples,isa,method,mrays_per_second,best_embree_mode,best_embree_mrays,occluded1_mrays,"
              "ratio_best,ratio_occluded1,ray_mismatch_rate");
    std::vector<Row> rows;
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const std::vector<std::string> f = split(lines[i], ',');
      EXPECT_EQ(f.size(), 12u) << lines[i];
      rows.push_back({f.at(0), f.at(1), f.at(2), f.at(3), f.at(4), f.at(6), std::stod(f.at(5)), std::stod(f.at(7)),
                      std::stod(f.at(8)), std::stod(f.at(9)), std::stod(f.at(10)), std::stod(f.at(11))});
    }
    return rows;
  }

  void expect_rejected(const Arguments& more, const std::string& word) const {
    Arguments arguments = {"rays", "--tiles", "1", "--rounds", "1", "--csv", path("rays.csv")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ProgramTest::expect_rejected(arguments, {word});
    EXPECT_THAT(files(), testing::IsEmpty());
  }
};

std::set<std::string> isas_of(const std::vector<Row>& rows, const std::string& method) {
  std::set<std::string> isas;
  for (const Row& row : rows) {
    if (row.method == method) isas.insert(row.isa);
  }
  return isas;
}

// Of one cell.
void expect_consistent(const std::vector<Row>& rows) {
  double best = 0, occluded1 = 0;
  for (const Row& row : rows) {
    if (row.method.starts_with("embree")) best = std::max(best, row.mrays_per_second);
    if (row.method.starts_with("embree1_")) occluded1 = std::max(occluded1, row.mrays_per_second);
  }
  for (const Row& row : rows) {
    EXPECT_GT(row.mrays_per_second, 0) << row.method;
    EXPECT_EQ(row.best_embree_mrays, best) << row.method;
    EXPECT_EQ(row.occluded1_mrays, occluded1) << row.method;
    EXPECT_NEAR(row.ratio_best, row.mrays_per_second / best, 1e-3 * row.ratio_best) << row.method;
    EXPECT_NEAR(row.ratio_occluded1, row.mrays_per_second / occluded1, 1e-3 * row.ratio_occluded1) << row.method;
    EXPECT_TRUE(row.method != row.best_embree_mode || row.mrays_per_second == best);
  }
}

// Every kernel answers the same, and nearly what robust Embree does. A tile has some 65,000 rays.
void expect_right_answers(const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    EXPECT_LE(row.ray_mismatch_rate, row.method.starts_with("lkao") ? 1e-4 : 1e-3) << row.method;
    if (row.method.starts_with("lkao")) {
      EXPECT_EQ(row.ray_mismatch_rate, rows.front().ray_mismatch_rate);
    }
  }
}

TEST_F(RaysCommand, MeasuresEveryMethodInEveryCell) {
  const std::vector<Row> rows = measure({"--scenes", "sphere,wall", "--samples", "64,128"});
  const std::vector<std::string> isas = available_isas();
  const std::size_t rows_per_cell = isas.size() + 1 + kEmbreeModeCount;
  ASSERT_EQ(rows.size(), 2 * 2 * 2 * rows_per_cell);  // scenes, radii, samples
  std::set<std::vector<std::string>> cells;
  for (std::size_t first = 0; first < rows.size(); first += rows_per_cell) {
    const std::vector<Row> cell(rows.begin() + static_cast<std::ptrdiff_t>(first),
                                rows.begin() + static_cast<std::ptrdiff_t>(first + rows_per_cell));
    cells.insert({cell[0].scene, cell[0].radius, cell[0].samples});
    std::set<std::string> methods;
    for (const Row& row : cell) methods.insert(row.method);
    EXPECT_EQ(methods.size(), 2u + kEmbreeModeCount);
    EXPECT_EQ(isas_of(cell, "lkao_simd"), std::set<std::string>(isas.begin(), isas.end()));
    EXPECT_EQ(isas_of(cell, "lkao_scalar"), std::set{isas.front()});
    expect_consistent(cell);
    expect_right_answers(cell);
  }
  EXPECT_EQ(cells.size(), 8u);
}

TEST_F(RaysCommand, ForcedIsaIsTheOnlyOne) {
  const std::string isa = available_isas().back();
  const std::vector<Row> rows = measure({"--scenes", "sphere", "--samples", "64", "--isa", isa});
  ASSERT_EQ(rows.size(), 2u * (1 + 1 + kEmbreeModeCount));
  for (const Row& row : rows) EXPECT_EQ(row.isa, isa);
  expect_right_answers(rows);
}

TEST_F(RaysCommand, AnswersAreRightOnAnyNumberOfThreads) {
  expect_right_answers(measure({"--scenes", "wall", "--samples", "64", "--threads", "3"}));
}

TEST_F(RaysCommand, ReadsViews) {
  write_file("tent.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0.5 1\n3 0 1 2\n3 0 1 3\n");
  const std::string views = write_file("views.json", R"({"scenes": [{"name": "tent", "file": "tent.off",
      "eye": [0.3, 0.3, 2], "target": [0.3, 0.3, 0], "up": [0, 1, 0], "fov": 40, "radii": [0.5]}]})");
  const std::vector<Row> rows = measure({"--views", views, "--samples", "64"});
  ASSERT_EQ(rows.size(), available_isas().size() + 1 + kEmbreeModeCount);
  EXPECT_EQ(rows[0].scene, "tent");
  EXPECT_EQ(rows[0].radius, "0.5");
  expect_right_answers(rows);
}

TEST_F(RaysCommand, BadInputIsOneLine) {
  expect_rejected({"--scenes", "sphere,cornell"}, "cornell");
  expect_rejected({"--views", path("nowhere.json")}, "nowhere.json");
  for (const char* samples : {"0", "100", "1088"}) {
    expect_rejected({"--scenes", "sphere", "--samples", samples}, "--samples");
  }
  expect_rejected({"--scenes", "sphere", "--isa", "mmx"}, "mmx");
  expect_rejected({"--scenes", "sphere", "--threads", "0"}, "--threads");
  expect_rejected({"--scenes", "sphere", "--shiny"}, "--shiny");
}

TEST_F(RaysCommand, BadViewsAreOneLine) {
  const std::string views = write_file("views.json", R"({"scenes": []})");
  for (const auto& [arguments, words] :
       {std::pair<Arguments, std::string>{{}, "has no scenes"},
        std::pair<Arguments, std::string>{{"--scenes", "atrium"}, "no scene 'atrium'"}}) {
    Arguments all = {"rays", "--views", views};
    all.insert(all.end(), arguments.begin(), arguments.end());
    ProgramTest::expect_rejected(all, {words});
  }
}

}  // namespace
}  // namespace lkao::test
