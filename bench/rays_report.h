// What a speed comparison prints.
#pragma once

#include <string>
#include <vector>

#include "bench/measurement.h"
#include "bench/rays_cell.h"

namespace lkao::bench {

// A row for every cell.
Columns rays_table_columns();
Measurement rays_table_measurement(const Cell& cell);

// Of bounded cells, of unbounded ones and of all, a line for each instruction set and number of threads: the geometric
// mean of the ratios, the worst and the best cell, the largest mismatch rate. Then how much faster more threads are.
// `cells` is not empty.
std::string rays_summary(const std::vector<Cell>& cells);

}  // namespace lkao::bench
