// Handles of the C interface that end with their scope, and a scene in both interfaces.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "lkao/c.h"
#include "lkao/lkao.h"
#include "support/meshes.h"

namespace lkao::tests {

template <typename Handle, lkao_status (*kDestroy)(Handle*)>
struct Destroyer {
  void operator()(Handle* handle) const { EXPECT_EQ(kDestroy(handle), LKAO_OK); }
};
template <typename Handle, lkao_status (*kDestroy)(Handle*)>
using Owned = std::unique_ptr<Handle, Destroyer<Handle, kDestroy>>;

using OwnedPattern = Owned<lkao_pattern, lkao_pattern_destroy>;
using OwnedTable = Owned<lkao_table, lkao_table_destroy>;
using OwnedBvh = Owned<lkao_bvh, lkao_bvh_destroy>;
using OwnedScene = Owned<lkao_scene, lkao_scene_destroy>;
using OwnedAo = Owned<lkao_ao, lkao_ao_destroy>;
using OwnedNeighbourhood = Owned<lkao_neighbourhood, lkao_neighbourhood_destroy>;

// What one of the functions lkao_*_create* makes of these arguments.
template <typename Owner, typename Function, typename... Arguments>
Owner made(Function create, Arguments... arguments) {
  typename Owner::pointer handle = nullptr;
  EXPECT_EQ(create(arguments..., &handle), LKAO_OK) << lkao_last_error();
  return Owner(handle);
}

inline lkao_mesh c_mesh(const Mesh& mesh) {
  lkao_mesh result = LKAO_MESH_INIT;
  result.positions = mesh.positions.data();
  result.position_count = mesh.positions.size();
  result.indices = mesh.triangles.data();
  result.triangle_count = mesh.triangles.size();
  return result;
}

inline OwnedBvh c_bvh(const Mesh& mesh) {
  const lkao_mesh view = c_mesh(mesh);
  return made<OwnedBvh>(lkao_bvh_create, &view, nullptr);
}

inline OwnedScene c_scene(const Mesh& mesh) {
  const lkao_mesh view = c_mesh(mesh);
  return made<OwnedScene>(lkao_scene_create, &view, nullptr);
}

inline OwnedPattern c_pattern(int ray_count) {
  return made<OwnedPattern>(lkao_pattern_create_standard, ray_count, LKAO_COSINE);
}

inline lkao_ray_options c_rays(float radius) {
  lkao_ray_options options = LKAO_RAY_OPTIONS_INIT;
  options.radius = radius;
  return options;
}

inline OwnedAo c_ao(const OwnedScene& scene, const OwnedPattern& pattern, const lkao_ray_options& options) {
  return made<OwnedAo>(lkao_ao_create, scene.get(), pattern.get(), &options, LKAO_SIMD);
}

inline lkao_receiver c_receiver(const Receiver& from) {
  lkao_receiver result = LKAO_RECEIVER_INIT;
  for (int axis = 0; axis < 3; ++axis) {
    result.position[axis] = from.position[axis];
    result.normal[axis] = from.normal[axis];
    result.geometric_normal[axis] = from.geometric_normal[axis];
  }
  result.excluded_primitive = from.excluded_primitive;
  result.excluded_instance = from.excluded_instance;
  result.occluder_groups = from.occluder_groups;
  return result;
}

}  // namespace lkao::tests
