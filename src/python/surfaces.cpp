#include "python/surfaces.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

#include <pybind11/stl.h>
#include <glm/geometric.hpp>

#include "python/bindings.h"
#include "python/meshes.h"
#include "python/words.h"
#include "scene/defects.h"
#include "scene/facet.h"

namespace lkao::python {
namespace {

constexpr Word<scene::NormalSource> kNormals[] = {{"facet", scene::NormalSource::facet},
                                                  {"smooth", scene::NormalSource::smooth},
                                                  {"file", scene::NormalSource::file}};

// Values of vertices or of corners: `numbers` are those of each triangle's corners, or `none` where a value is not
// usable.
template <typename Value, typename IsUsable>
void take(const py::array& array, const scene::Mesh& mesh, std::vector<Value>& values, std::vector<glm::uvec3>& numbers,
          std::uint32_t none, const IsUsable& is_usable) {
  const std::span<const Value> rows = packed<Value, float>(array);
  const bool are_of_corners = array.ndim() == 3;
  require(rows.size() == (are_of_corners ? 3 * mesh.triangles.size() : mesh.positions.size()),
          "there must be a value for every vertex, or for every corner");
  values.assign(rows.begin(), rows.end());
  numbers.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    glm::uvec3 corners = are_of_corners ? glm::uvec3(3 * t, 3 * t + 1, 3 * t + 2) : mesh.triangles[t];
    for (int i = 0; i < 3; ++i) {
      if (!is_usable(values[corners[i]])) corners[i] = none;
    }
    numbers.push_back(corners);
  }
}

// Of length one, as those of files: what is so to a rounding stays as it is.
void take_normals(const py::array& array, scene::Mesh& mesh) {
  constexpr double kRounding = 1e-6;
  take(array, mesh, mesh.normals, mesh.normal_corners, scene::kNoNormal, [](const glm::vec3& normal) {
    const double length = glm::length(glm::dvec3(normal));
    return length > 0 && std::isfinite(length);
  });
  for (glm::vec3& normal : mesh.normals) {
    const double length = glm::length(glm::dvec3(normal));
    if (std::abs(length - 1) > kRounding) normal = glm::vec3(glm::dvec3(normal) / length);
  }
}

void take_uvs(const py::array& array, scene::Mesh& mesh) {
  take(array, mesh, mesh.uvs, mesh.uv_corners, scene::kNoUv,
       [](const glm::vec2& uv) { return std::isfinite(uv.x) && std::isfinite(uv.y); });
}

void take_materials(const py::array& array, scene::Mesh& mesh) {
  const std::span<const std::uint32_t> numbers = packed<std::uint32_t>(array);
  require(numbers.size() == mesh.triangles.size(), "there must be a material for every triangle");
  mesh.materials.assign(numbers.begin(), numbers.end());
}

}  // namespace

Surface::Surface(const py::array& positions, const py::array& triangles, const Triple& origin,
                 const std::string& source, const SurfaceArrays& more)
    : mesh_(mesh_of(positions, triangles, origin)), triangle_count_(mesh_.triangles.size()) {
  const scene::NormalSource normals = value_of(kNormals, source, "normals");
  if (more.normals) take_normals(*more.normals, mesh_);
  if (more.uvs) take_uvs(*more.uvs, mesh_);
  if (more.materials) take_materials(*more.materials, mesh_);
  mesh_.holes = holes_of(more.holes, triangle_count_);
  const py::gil_scoped_release unlocked;
  drop_bad_triangles();
  normals_.emplace(mesh_, normals);
}

void Surface::drop_bad_triangles() {
  kept_.reserve(triangle_count_);
  for (std::size_t t = 0; t < triangle_count_; ++t) {
    if (scene::Facet(mesh_, mesh_.triangles[t]).is_usable()) {
      kept_.push_back(t);
    } else {
      dropped_materials_.push_back(mesh_.materials.empty() ? scene::kNoMaterial : mesh_.materials[t]);
    }
  }
  scene::drop_bad_triangles(mesh_);
}

std::size_t Surface::dropped_count(std::optional<std::uint32_t> material) const {
  if (!material) return dropped_materials_.size();
  return static_cast<std::size_t>(std::count(dropped_materials_.begin(), dropped_materials_.end(), *material));
}

void bind_surfaces(py::module_& module) {
  py::class_<Surface, std::shared_ptr<Surface>>(module, "Surface")
      .def(py::init([](const py::array& positions, const py::array& triangles, const Triple& origin,
                       const std::string& normals, std::optional<py::array> given_normals, std::optional<py::array> uvs,
                       std::optional<py::array> materials, const MeshHoles* holes) {
             return std::make_shared<Surface>(
                 positions, triangles, origin, normals,
                 SurfaceArrays{std::move(given_normals), std::move(uvs), std::move(materials), holes});
           }),
           py::arg("positions"), py::arg("triangles"), py::arg("origin"), py::arg("normals"), py::arg("given_normals"),
           py::arg("uvs"), py::arg("materials"), py::arg("holes"));
}

}  // namespace lkao::python
