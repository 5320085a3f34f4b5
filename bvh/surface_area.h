// How good a finished hierarchy is, by the surface area heuristic: the larger a box, the more rays meet it.
#pragma once

#include "bvh/layout.h"

namespace lkao::bvh {

// Of all that can block a ray; the same on any number of threads.
SurfaceAreas surface_areas(const Layout& layout);

// As BuildReport::surface_area_cost says.
double surface_area_cost(const SurfaceAreas& areas);

// As BuildReport::growth says.
double growth(const SurfaceAreas& now, const SurfaceAreas& built);

}  // namespace lkao::bvh
