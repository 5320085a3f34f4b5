// The parts of the extension module lkao._lkao. It is private: its names and arguments are those that the package
// lkao/ around it calls, which says what they mean and checks what users pass.
#pragma once

#include <pybind11/pybind11.h>

namespace lkao::python {

namespace py = pybind11;

void bind_patterns(py::module_& module);
void bind_scenes(py::module_& module);
void bind_receivers(py::module_& module);
void bind_queries(py::module_& module);
void bind_bundles(py::module_& module);
void bind_lights(py::module_& module);
void bind_meshes(py::module_& module);
void bind_levels(py::module_& module);
void bind_holes(py::module_& module);
void bind_surfaces(py::module_& module);
void bind_baking(py::module_& module);
void bind_textures(py::module_& module);
void bind_gl(py::module_& module);

}  // namespace lkao::python
