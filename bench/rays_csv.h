// The CSV of a speed comparison, written and read.
#pragma once

#include <string>
#include <vector>

#include "rays_cell.h"

namespace lkao::bench {

// Begins with lines of '#': where the figures come from.
std::string rays_csv_heading(const MeasureOptions& options);
// A row for every method. The columns of Embree's best mode and of rtcOccluded1 are the cell's own in each of them;
// ratios are those of speed_ratio.
std::string rays_csv_rows(const Cell& cell);

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
