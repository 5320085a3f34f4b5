// What a comparison of builds prints and writes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/build_cost.h"
#include "bench/measurement.h"
#include "bench/tree_quality.h"

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

// Of every method; the ratios are lkao's over this method's, unknown where lkao was not measured.
std::vector<Measurement> build_measurements(const BuildCell& cell);
Columns build_csv_columns();
// The hierarchies of lkao, and how fast queries are in them: of measurements with a quality.
Columns build_quality_columns();

// A row for every cell, these methods side by side.
Columns build_table_columns(const std::vector<BuildMethod>& methods);
Measurement build_table_measurement(const BuildCell& cell);

// Geometric means and worst cells of lkao against the other methods. Empty where there is nothing to compare.
std::string build_summary(const std::vector<BuildCell>& cells);

}  // namespace lkao::bench
