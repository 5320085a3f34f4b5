// What a comparison of builds prints and writes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "build_cost.h"

namespace lkao::bench {

struct BuildResult {
  BuildMethod method;
  double seconds;  // the median
  double bytes_per_triangle, mesh_bytes_per_triangle;
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

std::string build_csv_heading();
// A row for every method; the ratios are lkao's over this method's, empty where lkao was not measured.
std::string build_csv_rows(const BuildCell& cell);

std::string build_table_heading();
std::string build_table_row(const BuildCell& cell);
// Geometric means and worst cells of lkao against each of Embree's qualities. Empty without both of them.
std::string build_summary(const std::vector<BuildCell>& cells);

}  // namespace lkao::bench
