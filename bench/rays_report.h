// What a speed comparison prints.
#pragma once

#include <string>
#include <vector>

#include "rays_cell.h"

namespace lkao::bench {

std::string rays_table_heading();
std::string rays_table_row(const Cell& cell);

// Of bounded cells, of unbounded ones and of all, a line for each instruction set and number of threads: the geometric
// mean of the ratios, the worst and the best cell, the largest mismatch rate. Then how much faster more threads are.
// `cells` is not empty.
std::string rays_summary(const std::vector<Cell>& cells);

}  // namespace lkao::bench
