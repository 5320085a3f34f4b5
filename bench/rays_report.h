// What a speed comparison prints and writes.
#pragma once

#include <string>
#include <vector>

#include "rays_cell.h"

namespace lkao::bench {

std::string rays_csv_heading();
// A row for every method. The columns of Embree's best mode and of rtcOccluded1 are the cell's own in each of them.
std::string rays_csv_rows(const Cell& cell);

std::string rays_table_heading();
std::string rays_table_row(const Cell& cell);
// Geometric means of the SIMD kernel's ratios, the worst cell and the largest mismatch rate. `cells` is not empty.
std::string rays_summary(const std::vector<Cell>& cells);

}  // namespace lkao::bench
