#include "rays_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace lkao::bench {
namespace {

double ratio(const MethodResult& a, const MethodResult& b) { return a.mrays_per_second / b.mrays_per_second; }

double ratio_best(const Cell& cell) { return ratio(cell.simd(), cell.best_embree()); }
double ratio_occluded1(const Cell& cell) { return ratio(cell.simd(), cell.occluded1()); }
double mismatch_rate(const Cell& cell) { return cell.simd().mismatch_rate; }

template <typename Value>
double geometric_mean(const std::vector<Cell>& cells, const Value& value) {
  double sum = 0;
  for (const Cell& cell : cells) sum += std::log(value(cell));
  return std::exp(sum / static_cast<double>(cells.size()));
}

template <typename Value>
const Cell& smallest(const std::vector<Cell>& cells, const Value& value) {
  return *std::min_element(cells.begin(), cells.end(),
                           [&](const Cell& a, const Cell& b) { return value(a) < value(b); });
}

std::string place(const Cell& cell) {
  return fmt::format("{}, radius {:g}, {} rays", cell.scene, cell.radius, cell.ray_count);
}

// How fast the other instruction sets are.
std::string compare_isas(const std::vector<Cell>& cells) {
  const std::vector<std::string>& isas = cells.front().isas;
  std::string text;
  for (std::size_t i = 1; i < isas.size(); ++i) {  // results begin with these
    const double share = geometric_mean(cells, [&](const Cell& cell) { return ratio(cell.results[i], cell.simd()); });
    text += fmt::format("{}{} {:.2f}", i > 1 ? ", " : "", isas[i], share);
  }
  return text.empty() ? "" : fmt::format("Speed of other instruction sets relative to {}: {}\n", isas[0], text);
}

}  // namespace

std::string rays_csv_heading() {
  return "scene,radius,samples,isa,method,mrays_per_second,best_embree_mode,best_embree_mrays,occluded1_mrays,"
         "ratio_best,ratio_occluded1,ray_mismatch_rate\n";
}

std::string rays_csv_rows(const Cell& cell) {
  const MethodResult& best = cell.best_embree();
  const MethodResult& occluded1 = cell.occluded1();
  std::string rows;
  for (const MethodResult& result : cell.results) {
    rows += fmt::format("{},{:g},{},{},{},{:.6g},{},{:.6g},{:.6g},{:.5g},{:.5g},{:.4g}\n", cell.scene, cell.radius,
                        cell.ray_count, result.isa, result.method, result.mrays_per_second, best.method,
                        best.mrays_per_second, occluded1.mrays_per_second, ratio(result, best),
                        ratio(result, occluded1), result.mismatch_rate);
  }
  return rows;
}

std::string rays_table_heading() {
  return fmt::format("{:16} {:>8} {:>5} {:>8} | {:>8} {:>8} | {:28} {:>8} | {:>6} {:>8} | {:>9}\n", "scene", "radius",
                     "rays", "isa", "lkao", "scalar", "best of Embree", "Mrays/s", "x best", "x single", "mismatch");
}

std::string rays_table_row(const Cell& cell) {
  const MethodResult& best = cell.best_embree();
  return fmt::format("{:16} {:8g} {:5} {:>8} | {:8.2f} {:8.2f} | {:28} {:8.2f} | {:6.2f} {:8.2f} | {:9.2g}\n",
                     cell.scene, cell.radius, cell.ray_count, cell.simd().isa, cell.simd().mrays_per_second,
                     cell.scalar().mrays_per_second, best.method, best.mrays_per_second, ratio_best(cell),
                     ratio_occluded1(cell), mismatch_rate(cell));
}

std::string rays_summary(const std::vector<Cell>& cells) {
  const Cell& worst = smallest(cells, ratio_best);
  const Cell& most_wrong = smallest(cells, [](const Cell& cell) { return -mismatch_rate(cell); });
  return fmt::format(
      "\nGeometric mean of {} cells: {:.2f} x Embree's best mode, {:.2f} x rtcOccluded1\n"
      "Worst cell: {:.2f} x ({})\n"
      "Largest mismatch rate with robust Embree: {:.2g} ({})\n"
      "{}",
      cells.size(), geometric_mean(cells, ratio_best), geometric_mean(cells, ratio_occluded1), ratio_best(worst),
      place(worst), mismatch_rate(most_wrong), place(most_wrong), compare_isas(cells));
}

}  // namespace lkao::bench
