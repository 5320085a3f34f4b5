// What a comparison of builds prints and writes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "build_cost.h"
#include "tree_quality.h"

namespace lkao::bench {

struct BuildResult {
  BuildMethod method;
  double seconds, cpu_seconds;  // medians
  double bytes_per_triangle, mesh_bytes_per_triangle;
  std::optional<TreeQuality> quality = std::nullopt;        // of lkao's methods
  std::optional<double> query_microseconds = std::nullopt;  // a receiver; where it was measured
};

// One mesh on one number of threads.
struct BuildCell {
  std::string scene;
  std::size_t triangle_count;
  int thread_count;
  std::vector<BuildResult> results;

  // Null where the method was not measured.
  const BuildResult* find(BuildMethod method) const;
};

// Where the figures come from, and the names of the columns.
std::string build_csv_heading();
// A row for every method; the ratios are lkao's over this method's, empty where lkao was not measured.
std::string build_csv_rows(const BuildCell& cell);

std::string build_table_heading();
std::string build_table_row(const BuildCell& cell);

// The hierarchies of lkao, and how fast queries are in them.
std::string build_quality_heading();
std::string build_quality_rows(const BuildCell& cell);

// Geometric means and worst cells of lkao against the other methods. Empty where there is nothing to compare.
std::string build_summary(const std::vector<BuildCell>& cells);

}  // namespace lkao::bench
