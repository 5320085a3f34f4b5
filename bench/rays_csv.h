// The CSV of a speed comparison, written and read.
#pragma once

#include <string>
#include <vector>

#include "bench/measurement.h"
#include "bench/rays_cell.h"

namespace lkao::bench {

Columns rays_csv_columns();
// A measurement for every method. The columns of Embree's best mode and of rtcOccluded1 are the cell's own in each of
// them; ratios are those of speed_ratio.
std::vector<Measurement> rays_measurements(const Cell& cell);

// What is read of a row.
struct RaysCsvRow {
  std::string scene, radius, samples, isa, method, group, threads;
  double ratio_best = 0;
};

struct RaysCsv {
  std::string path;
  std::vector<std::string> comments;  // lines of '#'
  std::vector<RaysCsvRow> rows;
};

// Throws std::runtime_error with one line that names the file and the fault.
RaysCsv read_rays_csv(const std::string& path);

}  // namespace lkao::bench
