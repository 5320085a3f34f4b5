// How good a finished hierarchy is.
#pragma once

#include "bvh/layout.h"

namespace lkao::bvh {

// As BuildReport::surface_area_cost says; 0 where there is no occluder. The same on any number of threads.
double surface_area_cost(const Layout& layout);

}  // namespace lkao::bvh
