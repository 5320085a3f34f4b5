// lkao-bench rays, on scenes so small that its speeds mean nothing.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/program.h"
#include "lkao/isa.h"

namespace lkao::test::rays_command_test {
namespace {

constexpr int kEmbreeModeCount = 10;

constexpr const char* kHeading =
    "scene,radius,samples,isa,method,mrays_per_second,best_embree_mode,best_embree_mrays,occluded1_mrays,ratio_best,"
    "ratio_occluded1,ray_mismatch_rate,group,threads";

struct Row {
  std::string scene, radius, samples, isa, method, best_embree_mode, group, threads;
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
    table_ = expect_success(arguments).out;
    EXPECT_THAT(table_, testing::HasSubstr("Geometric mean of all cells"));
    EXPECT_THAT(table_, testing::HasSubstr("worst cell"));
    return read_rows();
  }

  std::vector<Row> read_rows() const {
    std::vector<std::string> lines = split(read_file("rays.csv"), '\n');
    const auto heading = std::find_if(lines.begin(), lines.end(), [](const auto& line) { return line[0] != '#'; });
    EXPECT_EQ(*heading, kHeading);
    std::vector<Row> rows;
    for (auto line = heading + 1; line != lines.end(); ++line) {
      const std::vector<std::string> f = split(*line, ',');
      EXPECT_EQ(f.size(), 14u) << *line;
      rows.push_back({f.at(0), f.at(1), f.at(2), f.at(3), f.at(4), f.at(6), f.at(12), f.at(13), std::stod(f.at(5)),
                      std::stod(f.at(7)), std::stod(f.at(8)), std::stod(f.at(9)), std::stod(f.at(10)),
                      std::stod(f.at(11))});
    }
    return rows;
  }

  void expect_rejected(const Arguments& more, const std::string& word) const {
    Arguments arguments = {"rays", "--tiles", "1", "--rounds", "1", "--csv", path("rays.csv")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ProgramTest::expect_rejected(arguments, {word});
    EXPECT_THAT(files(), testing::IsEmpty());
  }

  std::string table_;
};

// Of those that are measured by default, the ones of this processor.
std::set<std::string> default_isas() {
  std::set<std::string> isas;
  for (const std::string& isa : available_isas()) {
    if (isa == "avx2" || isa == "sse4") isas.insert(isa);
    if (isa.starts_with("avx3") || isa.starts_with("avx10")) isas.insert("avx512");
  }
  return isas;
}

// By what they answer.
std::map<std::vector<std::string>, std::vector<Row>> cells_of(const std::vector<Row>& rows) {
  std::map<std::vector<std::string>, std::vector<Row>> cells;
  for (const Row& row : rows) cells[{row.scene, row.radius, row.samples, row.isa, row.threads}].push_back(row);
  return cells;
}

std::set<std::string> values_of(const std::vector<Row>& rows, std::string Row::*field) {
  std::set<std::string> values;
  for (const Row& row : rows) values.insert(row.*field);
  return values;
}

// Of the rows of one method.
std::set<std::string> values_of(const std::vector<Row>& rows, const std::string& method, std::string Row::*field) {
  std::vector<Row> chosen;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(chosen),
               [&](const Row& row) { return row.method == method; });
  return values_of(chosen, field);
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

using Strings = std::set<std::string>;

TEST_F(RaysCommand, MeasuresEveryMethodInEveryCell) {
  const std::vector<Row> rows = measure({"--scenes", "sphere,wall", "--samples", "64,128"});
  const auto cells = cells_of(rows);
  EXPECT_EQ(cells.size(), 2 * 3 * 2 * default_isas().size());  // scenes, radii, samples
  EXPECT_EQ(values_of(rows, "lkao_scalar", &Row::isa).size(), 1u);
  for (const auto& [key, cell] : cells) {
    EXPECT_EQ(cell.size(), 3 + values_of(cell, "lkao_scalar", &Row::method).size() + kEmbreeModeCount);
    EXPECT_EQ(values_of(cell, &Row::method).size(), cell.size());
    expect_consistent(cell);
    expect_right_answers(cell);
  }
}

TEST_F(RaysCommand, EachSceneHasBoundedAndUnboundedCells) {
  const std::vector<Row> rows = measure({"--scenes", "sphere", "--samples", "64", "--isa", "sse4"});
  EXPECT_EQ(values_of(rows, &Row::radius).size(), 3u);
  for (const Row& row : rows) EXPECT_EQ(row.group, row.radius == "inf" ? "unbounded" : "bounded");
  for (const char* group : {"bounded", "unbounded", "all"}) {
    EXPECT_THAT(table_, testing::HasSubstr(std::string("Geometric mean of ") + group + " cells"));
  }
}

TEST_F(RaysCommand, RadiiReplaceThoseOfTheScene) {
  const std::vector<Row> rows =
      measure({"--scenes", "sphere", "--samples", "64", "--isa", "sse4", "--radius", "0.25,1000,inf,inf"});
  EXPECT_EQ(values_of(rows, &Row::radius), (Strings{"0.25", "1000", "inf"}));
  EXPECT_EQ(rows.size(), 3u * (4 + kEmbreeModeCount));
  for (const Row& row : rows) EXPECT_EQ(row.group, row.radius == "0.25" ? "bounded" : "unbounded");
  expect_right_answers(cells_of(rows).begin()->second);
}

TEST_F(RaysCommand, NamedIsasAreTheOnlyOnes) {
  const std::string isa = available_isas().back();
  const std::vector<Row> rows = measure({"--scenes", "sphere", "--samples", "64", "--radius", "1", "--isa", isa});
  EXPECT_EQ(values_of(rows, &Row::isa), Strings{isa});
  expect_right_answers(rows);
  const std::string best = *default_isas().begin();
  const std::string worst = *default_isas().rbegin();
  EXPECT_EQ(values_of(measure({"--scenes", "sphere", "--samples", "64", "--radius", "1", "--isa", best + "," + worst}),
                      "embree8_coherent", &Row::isa),
            (Strings{best, worst}));
}

TEST_F(RaysCommand, AnswersAreRightOnAnyNumberOfThreads) {
  const std::vector<Row> rows =
      measure({"--scenes", "wall", "--samples", "64", "--radius", "1", "--isa", "sse4", "--threads", "3,1,3"});
  EXPECT_EQ(values_of(rows, "lkao_single", &Row::threads), (Strings{"1", "3"}));
  expect_right_answers(rows);
  EXPECT_THAT(table_, testing::HasSubstr("3 threads against 1: lkao"));
}

TEST_F(RaysCommand, AllThreadsMayBeAskedFor) {
  const std::vector<Row> rows =
      measure({"--scenes", "wall", "--samples", "64", "--radius", "1", "--isa", "sse4", "--threads", "all"});
  ASSERT_EQ(values_of(rows, &Row::threads).size(), 1u);
  EXPECT_GE(std::stoi(rows[0].threads), 1);
}

TEST_F(RaysCommand, SaysWhereItsFiguresAreFrom) {
  measure({"--scenes", "wall", "--samples", "64", "--radius", "1", "--isa", "sse4"});
  const std::string csv = read_file("rays.csv");
  for (const char* key : {"# processor: ", "CPU family", "# compiler: ", "# commit: ", "# time: "}) {
    EXPECT_THAT(csv, testing::HasSubstr(key));
  }
}

class RaysCommandViews : public RaysCommand {
 protected:
  // A tent of some 1.7 units.
  std::string write_views(const std::string& radii, const std::string& file = "tent.off") const {
    write_file("tent.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0.5 1\n3 0 1 2\n3 0 1 3\n");
    return write_file("views.json", R"({"scenes": [{"name": "tent", "file": ")" + file + R"(",
      "eye": [0.3, 0.3, 2], "target": [0.3, 0.3, 0], "up": [0, 1, 0], "fov": 40, "radii": )" +
                                        radii + "}]}");
  }
};

TEST_F(RaysCommandViews, AreReadAndInfinityAdded) {
  const std::vector<Row> rows = measure({"--views", write_views("[0.5]"), "--samples", "64"});
  EXPECT_EQ(rows[0].scene, "tent");
  EXPECT_EQ(values_of(rows, &Row::radius), (Strings{"0.5", "inf"}));
  for (const auto& [key, cell] : cells_of(rows)) expect_right_answers(cell);
}

TEST_F(RaysCommandViews, RadiusBeyondTheSceneStandsForInfinity) {
  const std::vector<Row> rows = measure({"--views", write_views("[3.5]"), "--samples", "64", "--isa", "sse4"});
  EXPECT_EQ(values_of(rows, &Row::radius), Strings{"3.5"});
  EXPECT_EQ(values_of(rows, &Row::group), Strings{"unbounded"});
  EXPECT_THAT(table_, testing::Not(testing::HasSubstr("Geometric mean of bounded cells")));
}

TEST_F(RaysCommandViews, FaultsAreOneLineBeforeAnythingIsMeasured) {
  struct Case {
    std::string radii, file;
    std::vector<std::string> words;
  };
  for (const auto& [radii, file, words] :
       {Case{"[1, -2]", "tent.off", {"views.json", "tent", "-2"}},
        Case{"[]", "tent.off", {"views.json", "tent", "no radii"}}, Case{R"(["long"])", "tent.off", {"views.json"}},
        Case{"[1]", "flag.off", {"flag.off", "cannot be read"}}}) {
    ProgramTest::expect_rejected({"rays", "--csv", path("rays.csv"), "--views", write_views(radii, file)}, words);
    EXPECT_THAT(files(), testing::Not(testing::Contains("rays.csv")));
  }
}

TEST_F(RaysCommand, BadInputIsOneLine) {
  expect_rejected({"--scenes", "sphere,cornell"}, "cornell");
  expect_rejected({"--views", path("nowhere.json")}, "nowhere.json");
  for (const char* samples : {"0", "1025", "1088"}) {
    expect_rejected({"--scenes", "sphere", "--samples", samples}, "--samples");
  }
  for (const char* radius : {"0", "-1", "1,-1", "nan", "-inf", "2e18", "far"}) {
    expect_rejected({"--scenes", "sphere", "--radius", radius}, "--radius");
  }
  expect_rejected({"--scenes", "sphere", "--isa", "mmx"}, "mmx");
  expect_rejected({"--scenes", "sphere", "--isa", "sse4,mmx"}, "mmx");
  for (const char* threads : {"0", "1,0", "-1", "many", "1025"}) {
    expect_rejected({"--scenes", "sphere", "--threads", threads}, "--threads");
  }
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
}  // namespace lkao::test::rays_command_test
