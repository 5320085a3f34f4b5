// Levels of detail.
#include <pybind11/stl.h>

#include "lod/simplify.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/long_call.h"
#include "python/meshes.h"

namespace lkao::python {
namespace {

// For each level positions less the origin, triangles, epsilon, r_min and r_max. `radius` says epsilon where that is 0.
py::list simplify(const py::array& positions, const py::array& triangles, const Triple& origin, float radius,
                  float epsilon, float k, float growth, int level_count, int thread_count, const py::object& progress) {
  const scene::Mesh mesh = mesh_of(positions, triangles, origin);
  lod::SimplifyOptions options;
  options.levels = {.epsilon = epsilon, .k = k, .growth = growth, .level_count = level_count};
  lod::Simplified simplified = long_call(thread_count, progress, [&](const Progress& watch) {
    if (epsilon == 0) options.levels.epsilon = lod::automatic_epsilon(mesh, radius, options.levels);
    return lod::simplify(mesh, options, watch);
  });
  py::list levels;
  for (lod::Level& level : simplified.chain.levels) {
    levels.append(py::make_tuple(rows_of(std::move(level.mesh.positions)), rows_of(std::move(level.mesh.triangles)),
                                 level.epsilon, level.r_min, level.r_max));
  }
  return levels;
}

}  // namespace

void bind_levels(py::module_& module) {
  module.def("simplify", &simplify, py::arg("positions"), py::arg("triangles"), py::arg("origin"), py::arg("radius"),
             py::arg("epsilon"), py::arg("k"), py::arg("growth"), py::arg("level_count"), py::arg("thread_count"),
             py::arg("progress"));
}

}  // namespace lkao::python
