// How far speed comparisons of separate runs lie apart.
#pragma once

#include <span>
#include <string>

#include "bench/rays_csv.h"

namespace lkao::bench {

// Of one method of lkao: for each instruction set, number of threads and group (and all groups together), the geometric
// mean of ratio_best in each run; their least, median and largest; and the worst cell over all runs. Throws
// std::runtime_error with one line where the runs did not measure the same cells, or none by this method.
std::string spread_of_runs(std::span<const RaysCsv> runs, const std::string& method);

}  // namespace lkao::bench
