// Scenes: meshes, and instances of them anywhere in the world (lkao::OccluderScene). All queries ask a scene.
#pragma once

#include "lkao/c/bvh.h"
#include "lkao/c/status.h"

#define LKAO_ALL_GROUPS 0xffffffffu
// A transform that leaves all where it is.
#define LKAO_IDENTITY \
  { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f }

#ifdef __cplusplus
extern "C" {
#endif

// A scene may be changed. What was made of it stays as it was: it has the scene of that time, whose storage is shared
// as far as it is the same. Functions that take a const scene may run in any number of threads at once; one that
// changes it, alone.
typedef struct lkao_scene lkao_scene;

// Where a mesh of a scene stands.
typedef struct lkao_instance {
  size_t size;
  uint32_t mesh;       // of the scene's meshes
  uint32_t groups;     // it blocks rays of receivers that share a group (a bit) with it
  float to_world[12];  // affine, column by column: where the axes x, y and z go, and the origin
} lkao_instance;
#define LKAO_INSTANCE_INIT \
  { sizeof(lkao_instance), 0, LKAO_ALL_GROUPS, LKAO_IDENTITY }

// A mesh in a space of its own, and where it stands. Instances of the same arrays share one hierarchy.
typedef struct lkao_mesh_instance {
  size_t size;
  const lkao_mesh* mesh;
  float to_world[12];  // as of lkao_instance
} lkao_mesh_instance;
#define LKAO_MESH_INSTANCE_INIT \
  { sizeof(lkao_mesh_instance), NULL, LKAO_IDENTITY }

typedef struct lkao_scene_report {
  size_t size;
  size_t mesh_count;
  size_t instance_count;
  uint64_t occluder_count;  // of all instances together
  size_t memory_bytes;      // with the meshes' hierarchies
} lkao_scene_report;
#define LKAO_SCENE_REPORT_INIT \
  { sizeof(lkao_scene_report), 0, 0, 0, 0 }

// One mesh, where it is: lkao_bvh_create and lkao_scene_create_of_bvh in one.
LKAO_C_API lkao_status lkao_scene_create(const lkao_mesh* mesh, const lkao_build_options* options, lkao_scene** scene);
LKAO_C_API lkao_status lkao_scene_create_of_bvh(const lkao_bvh* bvh, lkao_scene** scene);
// Instances of meshes. They are an array of structs of instances[0].size bytes each. Build the meshes with
// keep_zero_area where they have triangles without area. `thread_count` as of lkao_build_options.
LKAO_C_API lkao_status lkao_scene_create_of_instances(const lkao_bvh* const* meshes, size_t mesh_count,
                                                      const lkao_instance* instances, size_t instance_count,
                                                      int32_t thread_count, lkao_scene** scene);
// The same from a renderer's arrays: builds a hierarchy for each mesh that is not yet there.
LKAO_C_API lkao_status lkao_scene_create_of_mesh_instances(const lkao_mesh_instance* instances, size_t instance_count,
                                                           const lkao_build_options* options, lkao_scene** scene);
LKAO_C_API lkao_status lkao_scene_destroy(lkao_scene* scene);

LKAO_C_API lkao_status lkao_scene_get_report(const lkao_scene* scene, lkao_scene_report* report);
// A box around all instances; lower = +infinity, upper = -infinity where there is no occluder.
LKAO_C_API lkao_status lkao_scene_get_bounds(const lkao_scene* scene, lkao_bounds* bounds);
LKAO_C_API lkao_status lkao_scene_get_origin(const lkao_scene* scene, double origin[3]);
LKAO_C_API lkao_status lkao_scene_get_instance(const lkao_scene* scene, uint32_t instance, lkao_instance* result);
// A new handle of the scene's mesh of that number.
LKAO_C_API lkao_status lkao_bvh_create_of_scene(const lkao_scene* scene, uint32_t mesh, lkao_bvh** bvh);

// `count` instances move: the instance instances[k] to the k-th transform, of 12 floats as in lkao_instance, which
// begin `stride` bytes apart (0: packed). Call it once for all that move in a frame.
LKAO_C_API lkao_status lkao_scene_move(lkao_scene* scene, const uint32_t* instances, const float* to_world,
                                       size_t stride, size_t count, int32_t thread_count);
LKAO_C_API lkao_status lkao_scene_set_groups(lkao_scene* scene, uint32_t instance, uint32_t groups);
// Another hierarchy in the place of a mesh.
LKAO_C_API lkao_status lkao_scene_set_mesh(lkao_scene* scene, uint32_t mesh, const lkao_bvh* bvh);

#ifdef __cplusplus
}
#endif
