#include "bench/spread.h"

#include <algorithm>
#include <compare>
#include <iterator>
#include <limits>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/geometric_mean.h"
#include "method/median.h"

namespace lkao::bench {
namespace {

constexpr const char* kAll = "all";

// Of the method in question.
using Rows = std::vector<RaysCsvRow>;

std::string place(const RaysCsvRow& row) {
  return fmt::format("{}, radius {}, {} rays", row.scene, row.radius, row.samples);
}

auto cell_of(const RaysCsvRow& row) { return std::tie(row.scene, row.radius, row.samples, row.isa, row.threads); }

bool is_same_cell(const RaysCsvRow& a, const RaysCsvRow& b) { return cell_of(a) == cell_of(b); }

// Sorted by cell, so that those of two runs can be compared.
Rows rows_by(const std::string& method, const RaysCsv& run) {
  Rows rows;
  std::copy_if(run.rows.begin(), run.rows.end(), std::back_inserter(rows),
               [&](const RaysCsvRow& row) { return row.method == method; });
  if (rows.empty()) throw std::runtime_error(fmt::format("{}: has no rows of method '{}'", run.path, method));
  std::sort(rows.begin(), rows.end(), [](const RaysCsvRow& a, const RaysCsvRow& b) { return cell_of(a) < cell_of(b); });
  return rows;
}

// The first cell that only one of two runs has, or that one has twice.
void check_same_cells(const RaysCsv& run_a, const Rows& a, const RaysCsv& run_b, const Rows& b) {
  const auto [at_a, at_b] = std::mismatch(a.begin(), a.end(), b.begin(), b.end(), is_same_cell);
  if (at_a == a.end() && at_b == b.end()) return;
  const RaysCsvRow& odd = at_a != a.end() ? *at_a : *at_b;
  throw std::runtime_error(fmt::format("{} and {} have different cells, such as {} ({}, {} threads)", run_a.path,
                                       run_b.path, place(odd), odd.isa, odd.threads));
}

// Each line of comments once: runs of one program on one machine have the same.
std::string comments_of(std::span<const RaysCsv> runs) {
  std::vector<std::string> lines;
  for (const RaysCsv& run : runs) {
    for (const std::string& line : run.comments) {
      if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
    }
  }
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

struct Line {
  std::string isa, threads, group;
  auto operator<=>(const Line&) const = default;
};

// What a line sums up: for each run, the ratios of its cells; and which of them is worst.
struct Ratios {
  explicit Ratios(std::size_t run_count) : by_run(run_count) {}

  void add(std::size_t run, const RaysCsvRow& row) {
    by_run[run].push_back(row.ratio_best);
    if (row.ratio_best >= worst) return;
    worst = row.ratio_best;
    worst_place = fmt::format("run {}: {}", run + 1, place(row));
  }

  std::vector<std::vector<double>> by_run;
  double worst = std::numeric_limits<double>::infinity();
  std::string worst_place;
};

std::map<Line, Ratios> collect(const std::vector<Rows>& rows_of_runs) {
  std::map<Line, Ratios> lines;
  for (std::size_t run = 0; run < rows_of_runs.size(); ++run) {
    for (const RaysCsvRow& row : rows_of_runs[run]) {
      for (const std::string& group : {row.group, std::string(kAll)}) {
        lines.try_emplace({row.isa, row.threads, group}, rows_of_runs.size()).first->second.add(run, row);
      }
    }
  }
  return lines;
}

std::string heading(std::size_t run_count) {
  std::string text = fmt::format("{:>8} {:>3} {:9} {:>5} |", "isa", "thr", "group", "cells");
  for (std::size_t run = 1; run <= run_count; ++run) text += fmt::format(" {:>6}", fmt::format("run {}", run));
  return text + fmt::format(" | {:>6} {:>6} {:>6} {:>6} | worst cell\n", "min", "median", "max", "spread");
}

std::string text_of(const Line& line, const Ratios& ratios) {
  std::string text =
      fmt::format("{:>8} {:>3} {:9} {:5} |", line.isa, line.threads, line.group, ratios.by_run.front().size());
  std::vector<double> means;
  for (const std::vector<double>& run : ratios.by_run) {
    means.push_back(geometric_mean(run));
    text += fmt::format(" {:6.3f}", means.back());
  }
  const auto [least, most] = std::minmax_element(means.begin(), means.end());
  const double median = method::median(means);
  return text + fmt::format(" | {:6.3f} {:6.3f} {:6.3f} {:5.1f}% | {:.2f} ({})\n", *least, median, *most,
                            100 * (*most - *least) / median, ratios.worst, ratios.worst_place);
}

}  // namespace

std::string spread_of_runs(std::span<const RaysCsv> runs, const std::string& method) {
  std::vector<Rows> rows;
  for (const RaysCsv& run : runs) {
    rows.push_back(rows_by(method, run));
    check_same_cells(runs.front(), rows.front(), run, rows.back());
  }
  std::string text = comments_of(runs) + fmt::format("Geometric means of {} against Embree's best mode, {} runs:\n{}",
                                                     method, runs.size(), heading(runs.size()));
  for (const auto& [line, ratios] : collect(rows)) text += text_of(line, ratios);
  return text;
}

}  // namespace lkao::bench
