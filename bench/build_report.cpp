#include "build_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "provenance.h"

namespace lkao::bench {
namespace {

struct Ratios {
  double seconds, cpu_seconds, memory;  // lkao's over the other's
};

std::optional<Ratios> ratios(const BuildCell& cell, BuildMethod method) {
  const BuildResult *own = cell.find(BuildMethod::lkao), *other = cell.find(method);
  if (own == nullptr || other == nullptr) return std::nullopt;
  return Ratios{own->seconds / other->seconds, own->cpu_seconds / other->cpu_seconds,
                own->bytes_per_triangle / other->bytes_per_triangle};
}

std::string summarize(const std::vector<BuildCell>& cells, BuildMethod method) {
  double log_seconds = 0, log_cpu_seconds = 0, log_memory = 0;
  Ratios worst{0, 0, 0};
  int count = 0;
  for (const BuildCell& cell : cells) {
    const std::optional<Ratios> r = ratios(cell, method);
    if (!r) continue;
    log_seconds += std::log(r->seconds), log_cpu_seconds += std::log(r->cpu_seconds), log_memory += std::log(r->memory);
    worst = {std::max(worst.seconds, r->seconds), std::max(worst.cpu_seconds, r->cpu_seconds),
             std::max(worst.memory, r->memory)};
    ++count;
  }
  if (count == 0) return "";
  return fmt::format(
      "lkao over {}, geometric mean (most): time {:.2f} ({:.2f}), processor time {:.2f} ({:.2f}), memory {:.2f} "
      "({:.2f})\n",
      name_of(method), std::exp(log_seconds / count), worst.seconds, std::exp(log_cpu_seconds / count),
      worst.cpu_seconds, std::exp(log_memory / count), worst.memory);
}

}  // namespace

const BuildResult* BuildCell::find(BuildMethod method) const {
  const auto found = std::find_if(results.begin(), results.end(), [&](const auto& r) { return r.method == method; });
  return found == results.end() ? nullptr : &*found;
}

std::string build_csv_heading() {
  return provenance_comment() +
         "scene,triangles,threads,method,seconds,cpu_seconds,bytes_per_triangle,mesh_bytes_per_triangle,time_ratio,cpu_"
         "time_ratio,"
         "memory_ratio,"
         "nodes,references,sah_nodes,sah_leaves,query_us\n";
}

std::string build_csv_rows(const BuildCell& cell) {
  std::string rows;
  for (const BuildResult& result : cell.results) {
    const std::optional<Ratios> r = ratios(cell, result.method);
    const auto& q = result.quality;
    rows += fmt::format(
        "{},{},{},{},{:.6g},{:.6g},{:.5g},{:.5g},{},{},{}\n", cell.scene, cell.triangle_count, cell.thread_count,
        name_of(result.method), result.seconds, result.cpu_seconds, result.bytes_per_triangle,
        result.mesh_bytes_per_triangle,
        r ? fmt::format("{:.5g},{:.5g},{:.5g}", r->seconds, r->cpu_seconds, r->memory) : ",,",
        q ? fmt::format("{},{},{:.5g},{:.5g}", q->node_count, q->reference_count, q->visited_nodes, q->visited_leaves)
          : ",,,",
        result.query_microseconds ? fmt::format("{:.5g}", *result.query_microseconds) : "");
  }
  return rows;
}

std::string build_table_heading() {
  std::string heading = fmt::format("{:16} {:>9} {:>7}", "scene", "triangles", "threads");
  for (const BuildMethod method : kBuildMethods) {
    heading += fmt::format(" | {:>14} {:>8}", name_of(method), "bytes/t");
    if (method != BuildMethod::lkao) heading += fmt::format(" {:>6} {:>8}", "x time", "x memory");
  }
  return heading + "\n";
}

std::string build_table_row(const BuildCell& cell) {
  std::string row = fmt::format("{:16} {:9} {:7}", cell.scene, cell.triangle_count, cell.thread_count);
  for (const BuildMethod method : kBuildMethods) {
    const BuildResult* result = cell.find(method);
    row += result ? fmt::format(" | {:12.3f} s {:8.1f}", result->seconds, result->bytes_per_triangle)
                  : fmt::format(" | {:>14} {:>8}", "-", "-");
    if (method == BuildMethod::lkao) continue;
    const std::optional<Ratios> r = ratios(cell, method);
    row += r ? fmt::format(" {:6.2f} {:8.2f}", r->seconds, r->memory) : fmt::format(" {:>6} {:>8}", "-", "-");
  }
  return row + "\n";
}

std::string build_quality_heading() {
  return fmt::format("\n{:16} {:>7} {:15} {:>9} {:>10} {:>9} {:>10} {:>11}\n", "scene", "threads", "method", "nodes",
                     "references", "sah nodes", "sah leaves", "us/receiver");
}

std::string build_quality_rows(const BuildCell& cell) {
  std::string rows;
  for (const BuildResult& result : cell.results) {
    const auto& q = result.quality;
    if (!q) continue;
    rows += fmt::format("{:16} {:7} {:15} {:9} {:10} {:9.2f} {:10.2f} {:>11}\n", cell.scene, cell.thread_count,
                        name_of(result.method), q->node_count, q->reference_count, q->visited_nodes, q->visited_leaves,
                        result.query_microseconds ? fmt::format("{:.3f}", *result.query_microseconds) : "-");
  }
  return rows;
}

std::string build_summary(const std::vector<BuildCell>& cells) {
  return summarize(cells, BuildMethod::lkao_no_splits) + summarize(cells, BuildMethod::embree_high) +
         summarize(cells, BuildMethod::embree_medium);
}

}  // namespace lkao::bench
