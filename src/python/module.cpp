// The extension module lkao._lkao.
#include <pybind11/pybind11.h>

#include "lkao/isa.h"
#include "lkao/progress.h"
#include "lkao/version.h"
#include "python/bindings.h"

PYBIND11_MODULE(_lkao, module) {
  namespace py = pybind11;
  module.attr("version") = lkao::version();
  py::register_exception<lkao::Cancelled>(module, "Cancelled", PyExc_RuntimeError).doc() =
      "A call was stopped by its progress function, which returned False.";
  module.def("active_isa", &lkao::active_isa);
  lkao::python::bind_patterns(module);
  lkao::python::bind_holes(module);
  lkao::python::bind_scenes(module);
  lkao::python::bind_receivers(module);
  lkao::python::bind_queries(module);
  lkao::python::bind_bundles(module);
  lkao::python::bind_lights(module);
  lkao::python::bind_meshes(module);
  lkao::python::bind_levels(module);
  lkao::python::bind_surfaces(module);
  lkao::python::bind_baking(module);
  lkao::python::bind_textures(module);
#if LKAO_PYTHON_GL
  lkao::python::bind_gl(module);
#endif
}
