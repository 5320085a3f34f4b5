#include "lkao/c/scene.h"

#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/gtc/type_ptr.hpp>

#include "c_api/arrays.h"
#include "c_api/convert.h"
#include "c_api/handles.h"
#include "c_api/meshes.h"
#include "c_api/versioned.h"

using namespace lkao::c_api;

namespace {

using Transform = Strided<const float, 12>;

std::vector<lkao::OccluderInstance> instances_of(const lkao_instance* instances, std::size_t count) {
  std::vector<lkao::OccluderInstance> result;
  result.reserve(count);
  for_each(instances, count, LKAO_INSTANCE_INIT, "instances", [&](const lkao_instance& from, const std::string&) {
    result.push_back({.mesh = from.mesh, .to_world = glm::make_mat4x3(from.to_world), .groups = from.groups});
  });
  return result;
}

std::vector<lkao::MeshInstance> mesh_instances_of(const lkao_mesh_instance* instances, std::size_t count) {
  std::vector<lkao::MeshInstance> result;
  result.reserve(count);
  for_each(instances, count, LKAO_MESH_INSTANCE_INIT, "instances",
           [&](const lkao_mesh_instance& from, const std::string& name) {
             const std::string mesh_name = name + "->mesh";
             const lkao_mesh mesh = read(from.mesh, LKAO_MESH_INIT, mesh_name.c_str());
             result.push_back(
                 {positions_of(mesh, mesh_name), triangles_of(mesh, mesh_name), glm::make_mat4x3(from.to_world)});
           });
  return result;
}

std::vector<lkao::InstanceMove> moves_of(const std::uint32_t* instances, const Transform& to_world, std::size_t count) {
  std::vector<lkao::InstanceMove> moves(count);
  for (std::size_t k = 0; k < count; ++k) {
    moves[k].instance = instances[k];
    to_world.get(k, &moves[k].to_world);
  }
  return moves;
}

}  // namespace

lkao_status lkao_scene_create(const lkao_mesh* mesh, const lkao_build_options* options, lkao_scene** scene) {
  return create(__func__, scene, "scene", [&] { return lkao::OccluderScene(build(mesh, options)); });
}

lkao_status lkao_scene_create_of_bvh(const lkao_bvh* bvh, lkao_scene** scene) {
  return create(__func__, scene, "scene", [&] { return lkao::OccluderScene(object(bvh, "bvh")); });
}

lkao_status lkao_scene_create_of_instances(const lkao_bvh* const* meshes, size_t mesh_count,
                                           const lkao_instance* instances, size_t instance_count, int32_t thread_count,
                                           lkao_scene** scene) {
  return create(__func__, scene, "scene", [&] {
    if (mesh_count > 0) needed(meshes, "meshes");
    std::vector<lkao::OccluderBvh> own_meshes;
    own_meshes.reserve(mesh_count);
    for (std::size_t i = 0; i < mesh_count; ++i) {
      own_meshes.push_back(object(meshes[i], ("meshes[" + std::to_string(i) + "]").c_str()));
    }
    const std::vector<lkao::OccluderInstance> own_instances = instances_of(instances, instance_count);
    std::optional<lkao::OccluderScene> made;
    run_on_threads(thread_count, "thread_count", [&] { made.emplace(std::move(own_meshes), own_instances); });
    return *std::move(made);
  });
}

lkao_status lkao_scene_create_of_mesh_instances(const lkao_mesh_instance* instances, size_t instance_count,
                                                const lkao_build_options* options, lkao_scene** scene) {
  return create(__func__, scene, "scene", [&] {
    const lkao_build_options how = read_or_defaults(options, LKAO_BUILD_OPTIONS_INIT, "options");
    const std::vector<lkao::MeshInstance> own_instances = mesh_instances_of(instances, instance_count);
    std::optional<lkao::OccluderScene> made;
    run_on_threads(how.thread_count, "options->thread_count", [&] {
      made.emplace(own_instances, build_options_of(how), progress_of(how.progress, how.progress_user));
    });
    return *std::move(made);
  });
}

lkao_status lkao_scene_destroy(lkao_scene* scene) { return destroy(__func__, scene, "scene"); }

lkao_status lkao_scene_get_report(const lkao_scene* scene, lkao_scene_report* report) {
  return guard(__func__, [&] {
    check_size(report, "report");
    const lkao::OccluderScene& from = object(scene, "scene");
    lkao_scene_report result = LKAO_SCENE_REPORT_INIT;
    result.mesh_count = from.mesh_count();
    result.instance_count = from.instance_count();
    result.occluder_count = from.occluder_count();
    result.memory_bytes = from.memory_bytes();
    write(result, report);
  });
}

lkao_status lkao_scene_get_bounds(const lkao_scene* scene, lkao_bounds* bounds) {
  return guard(__func__, [&] { *needed(bounds, "bounds") = c_bounds_of(object(scene, "scene").bounds()); });
}

lkao_status lkao_scene_get_origin(const lkao_scene* scene, double origin[3]) {
  return guard(__func__, [&] {
    needed(origin, "origin");
    write_origin(object(scene, "scene").origin(), origin);
  });
}

lkao_status lkao_scene_get_instance(const lkao_scene* scene, uint32_t instance, lkao_instance* result) {
  return guard(__func__, [&] {
    check_size(result, "result");
    const lkao::OccluderInstance from = object(scene, "scene").instance(instance);
    lkao_instance found = LKAO_INSTANCE_INIT;
    found.mesh = from.mesh;
    found.groups = from.groups;
    std::memcpy(found.to_world, &from.to_world, sizeof(found.to_world));
    write(found, result);
  });
}

lkao_status lkao_bvh_create_of_scene(const lkao_scene* scene, uint32_t mesh, lkao_bvh** bvh) {
  return create(__func__, bvh, "bvh", [&] { return object(scene, "scene").mesh(mesh); });
}

lkao_status lkao_scene_move(lkao_scene* scene, const uint32_t* instances, const float* to_world, size_t stride,
                            size_t count, int32_t thread_count) {
  return guard(__func__, [&] {
    lkao::OccluderScene& found = object(scene, "scene");
    if (count > 0) {
      needed(instances, "instances");
      needed(to_world, "to_world");
    }
    const std::vector<lkao::InstanceMove> moves = moves_of(instances, Transform(to_world, stride, "stride"), count);
    run_on_threads(thread_count, "thread_count", [&] { found.move(moves); });
  });
}

lkao_status lkao_scene_set_groups(lkao_scene* scene, uint32_t instance, uint32_t groups) {
  return guard(__func__, [&] { object(scene, "scene").set_groups(instance, groups); });
}

lkao_status lkao_scene_set_mesh(lkao_scene* scene, uint32_t mesh, const lkao_bvh* bvh) {
  return guard(__func__, [&] { object(scene, "scene").set_mesh(mesh, object(bvh, "bvh")); });
}
