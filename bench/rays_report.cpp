#include "bench/rays_report.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include "bench/geometric_mean.h"

namespace lkao::bench {
namespace {

using Cells = std::vector<Cell>;

double ratio_best(const Cell& cell) { return speed_ratio(cell.simd(), cell.best_embree()); }
double ratio_single(const Cell& cell) { return speed_ratio(cell.single(), cell.best_embree()); }
double ratio_around(const Cell& cell) { return speed_ratio(cell.around(), cell.best_embree()); }
double ratio_occluded1(const Cell& cell) { return speed_ratio(cell.simd(), cell.occluded1()); }

double mismatch_rate(const Cell& cell) {
  return std::max({cell.simd().mismatch_rate, cell.single().mismatch_rate, cell.around().mismatch_rate});
}

template <typename Test>
Cells select(const Cells& cells, const Test& test) {
  Cells chosen;
  std::copy_if(cells.begin(), cells.end(), std::back_inserter(chosen), test);
  return chosen;
}

double mean(const Cells& cells, const std::function<double(const Cell&)>& value) {
  std::vector<double> values;
  for (const Cell& cell : cells) values.push_back(value(cell));
  return geometric_mean(values);
}

bool is_slower(const Cell& a, const Cell& b) { return ratio_best(a) < ratio_best(b); }

std::string named_ratio(const Cell& cell) {
  return fmt::format("{:.2f} ({}, radius {:g}, {} rays)", ratio_best(cell), cell.scene, cell.radius, cell.ray_count);
}

const Columns kSummaryColumns = {{"isa", "{}", 8},
                                 {"threads", "{}", 3, "thr"},
                                 {"cells", "{}", 5},
                                 kBar,
                                 {"x best", "{:.2f}", 6},
                                 {"x single", "{:.2f}", 8},
                                 {"x around", "{:.2f}", 8},
                                 {"x Occluded1", "{:.2f}", 11},
                                 kBar,
                                 {"mismatch", "{:.2g}", 8},
                                 kBar,
                                 {"worst cell", "{}", -44},
                                 kBar,
                                 {"best cell"}};

// Cells of one instruction set and number of threads.
std::string summary_row(const Cells& cells) {
  const Cell& some = cells.front();
  const double most_wrong = mismatch_rate(*std::max_element(
      cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return mismatch_rate(a) < mismatch_rate(b); }));
  return table_row(kSummaryColumns,
                   {{"isa", some.isa.name},
                    {"threads", some.thread_count},
                    {"cells", cells.size()},
                    {"x best", mean(cells, ratio_best)},
                    {"x single", mean(cells, ratio_single)},
                    {"x around", mean(cells, ratio_around)},
                    {"x Occluded1", mean(cells, ratio_occluded1)},
                    {"mismatch", most_wrong},
                    {"worst cell", named_ratio(*std::min_element(cells.begin(), cells.end(), is_slower))},
                    {"best cell", named_ratio(*std::max_element(cells.begin(), cells.end(), is_slower))}});
}

std::vector<std::string> isas_of(const Cells& cells) {  // in the order of the cells
  std::vector<std::string> names;
  for (const Cell& cell : cells) {
    if (std::find(names.begin(), names.end(), cell.isa.name) == names.end()) names.push_back(cell.isa.name);
  }
  return names;
}

std::set<int> thread_counts_of(const Cells& cells) {
  std::set<int> counts;
  for (const Cell& cell : cells) counts.insert(cell.thread_count);
  return counts;
}

Cells cells_of(const Cells& cells, const std::string& isa, int thread_count) {
  return select(cells, [&](const Cell& cell) { return cell.isa.name == isa && cell.thread_count == thread_count; });
}

std::string group_summary(const std::string& name, const Cells& cells) {
  if (cells.empty()) return {};
  std::string text = fmt::format("\nGeometric mean of {} cells:\n{}", name, table_heading(kSummaryColumns));
  for (const std::string& isa : isas_of(cells)) {
    for (const int count : thread_counts_of(cells)) text += summary_row(cells_of(cells, isa, count));
  }
  return text;
}

// Of two lists of the same cells, on few threads and on many.
double thread_speed_up(const Cells& few, const Cells& many, const MethodResult& (*method)(const Cell&)) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < few.size(); ++i) {
    ratios.push_back(method(many[i]).mrays_per_second / method(few[i]).mrays_per_second);
  }
  return geometric_mean(ratios);
}

std::string thread_summary(const Cells& cells) {
  const std::set<int> counts = thread_counts_of(cells);
  std::string text;
  for (const std::string& isa : isas_of(cells)) {
    const Cells few = cells_of(cells, isa, *counts.begin());
    for (auto count = std::next(counts.begin()); count != counts.end(); ++count) {
      const Cells many = cells_of(cells, isa, *count);
      const auto speed_up = [&](auto method) { return thread_speed_up(few, many, method); };
      text +=
          fmt::format("{:>8}: {} threads against {}: lkao {:.2f} x, single queries {:.2f} x, best of Embree {:.2f} x\n",
                      isa, *count, *counts.begin(), speed_up([](const Cell& c) -> auto& { return c.simd(); }),
                      speed_up([](const Cell& c) -> auto& { return c.single(); }),
                      speed_up([](const Cell& c) -> auto& { return c.best_embree(); }));
    }
  }
  return text.empty() ? text : "\nSpeed-up of threads, geometric mean of all cells:\n" + text;
}

}  // namespace

Columns rays_table_columns() {
  return {{"scene", "{}", -16},
          {"radius", "{:g}", 8},
          {"samples", "{}", 5, "rays"},
          {"isa", "{}", 8},
          {"threads", "{}", 3, "thr"},
          kBar,
          {"simd", "{:.2f}", 8, "lkao"},
          {"single", "{:.2f}", 8},
          {"scalar", "{:.2f}", 8},
          kBar,
          {"best_embree_mode", "{}", -28, "best of Embree"},
          {"best_embree_mrays", "{:.2f}", 8, "Mrays/s"},
          kBar,
          {"ratio_best", "{:.2f}", 6, "x best"},
          {"ratio_single", "{:.2f}", 8, "x single"},
          {"ratio_occluded1", "{:.2f}", 11, "x Occluded1"},
          kBar,
          {"ray_mismatch_rate", "{:.2g}", 8, "mismatch"}};
}

Measurement rays_table_measurement(const Cell& cell) {
  const MethodResult& best = cell.best_embree();
  const MethodResult* scalar = cell.scalar();
  return {{"scene", cell.scene},
          {"radius", cell.radius},
          {"samples", cell.ray_count},
          {"isa", cell.isa.name},
          {"threads", cell.thread_count},
          {"simd", cell.simd().mrays_per_second},
          {"single", cell.single().mrays_per_second},
          {"scalar", scalar != nullptr ? Value(scalar->mrays_per_second) : Value()},
          {"best_embree_mode", best.method},
          {"best_embree_mrays", best.mrays_per_second},
          {"ratio_best", ratio_best(cell)},
          {"ratio_single", ratio_single(cell)},
          {"ratio_occluded1", ratio_occluded1(cell)},
          {"ray_mismatch_rate", mismatch_rate(cell)}};
}

std::string rays_summary(const std::vector<Cell>& cells) {
  std::string text;
  for (const std::string group : {kBounded, kUnbounded}) {
    text += group_summary(group, select(cells, [&](const Cell& cell) { return cell.group == group; }));
  }
  return text + group_summary("all", cells) + thread_summary(cells);
}

}  // namespace lkao::bench
