#include "python/receivers.h"

#include <utility>

#include <pybind11/stl.h>

#include "python/bindings.h"

namespace lkao::python {

Receivers::Receivers(py::array positions, py::array normals, std::optional<py::array> geometric_normals,
                     std::optional<py::array> excluded, std::optional<py::array> instances,
                     std::optional<py::array> groups, const Triple& origin)
    : positions_(std::move(positions)),
      normals_(std::move(normals)),
      excluded_(std::move(excluded), positions_.size()),
      instances_(std::move(instances), positions_.size()),
      groups_(std::move(groups), positions_.size()),
      origin_(vector_of(origin)) {
  if (geometric_normals) geometric_normals_.emplace(std::move(*geometric_normals));
  require(normals_.size() == size(), "there must be as many normals as positions");
  require(!geometric_normals_ || geometric_normals_->size() == size(), "there must be as many normals as positions");
}

void Receivers::get(std::size_t first, std::span<Receiver> part) const {
  for (std::size_t k = 0; k < part.size(); ++k) {
    const std::size_t i = first + k;
    part[k] = {.position = glm::vec3(positions_[i] - origin_), .normal = glm::vec3(normals_[i])};
    if (geometric_normals_) part[k].geometric_normal = glm::vec3((*geometric_normals_)[i]);
    if (excluded_) part[k].excluded_primitive = excluded_[i];
    if (instances_) part[k].excluded_instance = instances_[i];
    if (groups_) part[k].occluder_groups = groups_[i];
  }
}

void bind_receivers(py::module_& module) {
  py::class_<Receivers>(module, "Receivers")
      .def(py::init<py::array, py::array, std::optional<py::array>, std::optional<py::array>, std::optional<py::array>,
                    std::optional<py::array>, const Triple&>(),
           py::arg("positions"), py::arg("normals"), py::arg("geometric_normals"), py::arg("excluded"),
           py::arg("instances"), py::arg("groups"), py::arg("origin"));
  py::class_<QueryReport>(module, "QueryReport", "How many rays a batch cast, and how many were blocked.")
      .def_readonly("receiver_count", &QueryReport::receiver_count)
      .def_readonly("invalid_receiver_count", &QueryReport::invalid_receiver_count)
      .def_readonly("ray_count", &QueryReport::ray_count)
      .def_readonly("blocked_ray_count", &QueryReport::blocked_ray_count);
}

}  // namespace lkao::python
