// Occluders: meshes, and instances of them.
#include <memory>

#include <pybind11/stl.h>

#include "lkao/occluder_scene.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/holes.h"
#include "python/long_call.h"

namespace lkao::python {
namespace {

OccluderScene make_scene(const py::array& positions, const py::array& triangles, const Triple& origin,
                         bool spatial_splits, bool keep_zero_area, bool refer,
                         const std::optional<py::array>& opacities, const MeshHoles* holes, int thread_count,
                         const py::object& progress) {
  const TriangleMesh mesh{positions_of(positions, origin), triangles_of(triangles)};
  BuildOptions options{.spatial_splits = spatial_splits,
                       .keep_zero_area = keep_zero_area,
                       .mesh_storage = refer ? MeshStorage::refer : MeshStorage::copy};
  if (opacities) {
    const std::span<const float> values = packed<float>(*opacities);
    options.cut_outs.opacities.assign(values.begin(), values.end());
  }
  const std::shared_ptr<const scene::Holes> own_holes = holes_of(holes, mesh.triangles.size());
  return long_call(thread_count, progress, [&](const Progress& watch) {
    if (own_holes) options.cut_outs = scene::cut_outs_of(own_holes);
    return OccluderScene(OccluderBvh(mesh, options, watch));
  });
}

OccluderScene refitted(const OccluderScene& scene, const py::array& positions, const Triple& origin, double max_growth,
                       int thread_count, const py::object& progress) {
  const PositionView view = positions_of(positions, origin);
  const OccluderBvh mesh = scene.mesh(0);
  return long_call(thread_count, progress, [&](const Progress& watch) {
    return OccluderScene(mesh.refitted(view, {.max_growth = max_growth}, watch));
  });
}

// What numpy calls (3, 4).
struct Rows34 {
  float rows[3][4];
};

std::vector<glm::mat4x3> transforms_of(const py::array& array) {
  const std::span<const Rows34> matrices = packed<Rows34, float>(array);
  std::vector<glm::mat4x3> transforms;
  transforms.reserve(matrices.size());
  for (const Rows34& matrix : matrices) {
    glm::mat4x3 transform;
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 3; ++row) transform[column][row] = matrix.rows[row][column];
    }
    transforms.push_back(transform);
  }
  return transforms;
}

OccluderScene make_instances(const std::vector<OccluderScene>& meshes, const py::array& to_world,
                             const py::array& mesh_numbers, const py::array& groups, int thread_count) {
  const std::vector<glm::mat4x3> transforms = transforms_of(to_world);
  const std::span<const std::uint32_t> numbers = packed<std::uint32_t>(mesh_numbers);
  const std::span<const std::uint32_t> masks = packed<std::uint32_t>(groups);
  require(numbers.size() == transforms.size() && masks.size() == transforms.size(),
          "there must be as many meshes and groups as transforms");
  std::vector<OccluderBvh> hierarchies;
  hierarchies.reserve(meshes.size());
  for (const OccluderScene& mesh : meshes) hierarchies.push_back(mesh.mesh(0));
  std::vector<OccluderInstance> instances;
  instances.reserve(transforms.size());
  for (std::size_t i = 0; i < transforms.size(); ++i) {
    instances.push_back({.mesh = numbers[i], .to_world = transforms[i], .groups = masks[i]});
  }
  return long_call(thread_count, py::none(),
                   [&](const Progress&) { return OccluderScene(std::move(hierarchies), instances); });
}

// As make_instances takes them: transforms (n, 3, 4), numbers of meshes, groups.
py::tuple instances_of(const OccluderScene& scene) {
  const std::size_t count = scene.instance_count();
  std::vector<Rows34> matrices(count);
  std::vector<std::uint32_t> numbers(count), groups(count);
  for (std::size_t i = 0; i < count; ++i) {
    const OccluderInstance instance = scene.instance(static_cast<std::uint32_t>(i));
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 3; ++row) matrices[i].rows[row][column] = instance.to_world[column][row];
    }
    numbers[i] = instance.mesh;
    groups[i] = instance.groups;
  }
  return py::make_tuple(array_of<float>(std::move(matrices), {static_cast<py::ssize_t>(count), 3, 4}),
                        row_of(std::move(numbers)), row_of(std::move(groups)));
}

// Keeps the interpreter's lock, so that no other thread of Python sees a scene that is being changed.
void move(OccluderScene& scene, const py::array& numbers, const py::array& to_world) {
  const std::span<const std::uint32_t> instances = packed<std::uint32_t>(numbers);
  const std::vector<glm::mat4x3> transforms = transforms_of(to_world);
  require(instances.size() == transforms.size(), "there must be as many instances as transforms");
  std::vector<InstanceMove> moves;
  moves.reserve(instances.size());
  for (std::size_t i = 0; i < instances.size(); ++i) moves.push_back({instances[i], transforms[i]});
  scene.move(moves);
}

py::tuple bounds_of(const OccluderScene& scene) {
  const Bounds& bounds = scene.bounds();
  return py::make_tuple(triple_of(bounds.lower), triple_of(bounds.upper));
}

void bind_report(py::module_& module) {
  py::class_<BuildReport>(module, "BuildReport", "What a build found and made; counts, bytes and seconds.")
      .def_readonly("triangle_count", &BuildReport::triangle_count)
      .def_readonly("occluder_count", &BuildReport::occluder_count)
      .def_readonly("zero_area_count", &BuildReport::zero_area_count)
      .def_readonly("non_finite_count", &BuildReport::non_finite_count)
      .def_readonly("reference_count", &BuildReport::reference_count)
      .def_readonly("node_count", &BuildReport::node_count)
      .def_readonly("memory_bytes", &BuildReport::memory_bytes)
      .def_readonly("seconds", &BuildReport::seconds)
      .def_readonly("surface_area_cost", &BuildReport::surface_area_cost)
      .def_readonly("growth", &BuildReport::growth);
}

}  // namespace

void bind_scenes(py::module_& module) {
  bind_report(module);
  module.def(
      "choose_origin",
      [](const py::array& positions) { return triple_of(choose_origin(positions_of(positions, Triple{}))); },
      py::arg("positions"));
  py::class_<OccluderScene>(module, "OccluderScene")
      .def_static("make", &make_scene, py::arg("positions"), py::arg("triangles"), py::arg("origin"),
                  py::arg("spatial_splits"), py::arg("keep_zero_area"), py::arg("refer"), py::arg("opacities"),
                  py::arg("holes"), py::arg("thread_count"), py::arg("progress"))
      .def_static("make_instances", &make_instances, py::arg("meshes"), py::arg("to_world"), py::arg("mesh_numbers"),
                  py::arg("groups"), py::arg("thread_count"))
      .def("instances", &instances_of)
      .def("refitted", &refitted, py::arg("positions"), py::arg("origin"), py::arg("max_growth"),
           py::arg("thread_count"), py::arg("progress"))
      .def("move", &move, py::arg("numbers"), py::arg("to_world"))
      .def("set_groups", &OccluderScene::set_groups, py::arg("instance"), py::arg("groups"))
      .def(
          "set_mesh",
          [](OccluderScene& scene, std::uint32_t number, const OccluderScene& mesh) {
            scene.set_mesh(number, mesh.mesh(0));
          },
          py::arg("number"), py::arg("mesh"))
      .def(
          "report", [](const OccluderScene& scene, std::uint32_t mesh) { return scene.mesh(mesh).report(); },
          py::arg("mesh"))
      .def_property_readonly("mesh_count", &OccluderScene::mesh_count)
      .def_property_readonly("instance_count", &OccluderScene::instance_count)
      .def_property_readonly("occluder_count", &OccluderScene::occluder_count)
      .def_property_readonly("memory_bytes", &OccluderScene::memory_bytes)
      .def_property_readonly("bounds", &bounds_of)
      .def_property_readonly("origin", [](const OccluderScene& scene) { return triple_of(scene.origin()); });
}

}  // namespace lkao::python
