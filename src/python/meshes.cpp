// Mesh files and built-in scenes, and what cameras see of meshes.
#include "python/meshes.h"

#include <limits>

#include <pybind11/stl.h>

#include "python/bindings.h"
#include "python/holes.h"
#include "python/long_call.h"
#include "python/words.h"
#include "scene/load.h"

namespace lkao::python {

scene::Mesh mesh_of(const py::array& positions, const py::array& triangles, const Triple& origin) {
  const PositionView points = positions_of(positions, origin);
  const IndexView corners = triangles_of(triangles);
  scene::Mesh mesh;
  mesh.origin = points.origin();
  mesh.positions.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) mesh.positions.push_back(points[i]);
  mesh.triangles.reserve(corners.size());
  for (std::size_t t = 0; t < corners.size(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      const std::int64_t index = corners.index(t, corner);
      if (index >= 0 && index < static_cast<std::int64_t>(points.size())) continue;
      throw std::invalid_argument("triangle " + std::to_string(t) + " has the index " + std::to_string(index) +
                                  ", but there are " + std::to_string(points.size()) + " positions");
    }
    mesh.triangles.push_back(corners[t]);
  }
  return mesh;
}

scene::Camera camera_of(const Triple& eye, const Triple& target, const Triple& up, float fov) {
  return {.eye = glm::vec3(vector_of(eye)),
          .target = glm::vec3(vector_of(target)),
          .up = glm::vec3(vector_of(up)),
          .fov = fov};
}

namespace {

py::tuple load(const std::string& name) {
  scene::Mesh mesh = [&] {
    const py::gil_scoped_release unlocked;
    return scene::load(name);
  }();
  return py::make_tuple(rows_of(std::move(mesh.positions)), rows_of(std::move(mesh.triangles)), triple_of(mesh.origin));
}

// Values of corners, (m, 3, ...), NaN where a corner has none.
template <typename Value>
py::object of_corners(const std::vector<Value>& values, const std::vector<glm::uvec3>& numbers, std::uint32_t none) {
  if (numbers.empty()) return py::none();
  std::vector<Value> result;
  result.reserve(3 * numbers.size());
  for (const glm::uvec3& corners : numbers) {
    for (int i = 0; i < 3; ++i) {
      result.push_back(corners[i] == none ? Value(std::numeric_limits<float>::quiet_NaN()) : values[corners[i]]);
    }
  }
  return array_of<float>(std::move(result), {static_cast<py::ssize_t>(numbers.size()), 3, Value::length()});
}

// All that a file says of its surface: positions less the origin, triangles, the origin; normals and texture
// coordinates of corners, materials of triangles, holes, or None; names and (u, v) wraps of the materials; remarks.
py::tuple open_file(const std::string& name, int uv_set, bool opaque) {
  scene::MeshFile file = [&] {
    const py::gil_scoped_release unlocked;
    return scene::open(name, {.uv_set = uv_set, .decode_alpha = opaque ? nullptr : scene::DecodeAlpha(decode_alpha)});
  }();
  scene::Mesh& mesh = file.mesh;
  const py::object normals = of_corners(mesh.normals, mesh.normal_corners, scene::kNoNormal);
  const py::object uvs = of_corners(mesh.uvs, mesh.uv_corners, scene::kNoUv);
  py::object materials = py::none();
  if (!mesh.materials.empty()) materials = row_of(std::move(mesh.materials));
  const py::object holes = mesh.holes ? py::cast(MeshHoles{mesh.holes}) : py::none();
  py::list wraps;
  for (const scene::TextureWraps& wrap : file.contents.wraps) {
    wraps.append(py::make_tuple(word_of(kWraps, wrap.u), word_of(kWraps, wrap.v)));
  }
  return py::make_tuple(rows_of(std::move(mesh.positions)), rows_of(std::move(mesh.triangles)), triple_of(mesh.origin),
                        normals, uvs, materials, holes, file.contents.materials, wraps, file.contents.remarks);
}

// Of every pixel, row by row from the top: positions less the origin, normals, geometric normals, depths.
py::tuple view(const py::array& positions, const py::array& triangles, const Triple& origin, const MeshHoles* holes,
               const Triple& eye, const Triple& target, const Triple& up, float fov, int width, int height,
               bool smooth) {
  scene::Mesh mesh = mesh_of(positions, triangles, origin);
  mesh.holes = holes_of(holes, mesh.triangles.size());
  const scene::Camera camera = camera_of(eye, target, up, fov);
  const scene::NormalSource source = smooth ? scene::NormalSource::smooth : scene::NormalSource::facet;
  scene::ReceiverImage image = long_call(
      0, py::none(), [&](const Progress&) { return scene::find_receivers(mesh, camera, width, height, source); });
  std::vector<glm::vec3> points, normals, geometric_normals;
  points.reserve(image.receivers.size());
  normals.reserve(image.receivers.size());
  geometric_normals.reserve(image.receivers.size());
  for (const Receiver& receiver : image.receivers) {
    points.push_back(receiver.position);
    normals.push_back(receiver.normal);
    geometric_normals.push_back(receiver.geometric_normal);
  }
  return py::make_tuple(rows_of(std::move(points)), rows_of(std::move(normals)), rows_of(std::move(geometric_normals)),
                        row_of(std::move(image.depth)));
}

}  // namespace

void bind_meshes(py::module_& module) {
  module.def("load", &load, py::arg("name"));
  module.def("open_file", &open_file, py::arg("name"), py::arg("uv_set"), py::arg("opaque"));
  module.def("view", &view, py::arg("positions"), py::arg("triangles"), py::arg("origin"), py::arg("holes"),
             py::arg("eye"), py::arg("target"), py::arg("up"), py::arg("fov"), py::arg("width"), py::arg("height"),
             py::arg("smooth"));
}

}  // namespace lkao::python
