// Occluders: a triangle mesh, and the bounding volume hierarchy over it (lkao::OccluderBvh).
#pragma once

#include "lkao/c/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lkao_bvh lkao_bvh;

typedef int32_t lkao_number_type;
enum { LKAO_FLOAT = 0, LKAO_DOUBLE = 1, LKAO_UINT16 = 2, LKAO_UINT32 = 3, LKAO_INT32 = 4 };

// Where a hierarchy finds the corners of a triangle.
typedef int32_t lkao_mesh_storage;
enum {
  LKAO_STORAGE_COPY = 0,  // in a packed copy of its own
  LKAO_STORAGE_REFER = 1  // in the caller's arrays, which must stay as they are while anything made of it is in use
};

// An indexed triangle mesh in the caller's arrays, of any layout and at any alignment; nothing is kept of them after
// the call, but with LKAO_STORAGE_REFER. Each position begins `position_stride` bytes after the one before, each
// triangle `triangle_stride` bytes; 0: packed. The front of a triangle is the side from which its corners run
// counter-clockwise; its place in the array is its primitive number.
typedef struct lkao_mesh {
  size_t size;
  const void* positions;  // three numbers each; NULL where there are none
  size_t position_count;
  size_t position_stride;
  lkao_number_type position_type;  // LKAO_FLOAT or LKAO_DOUBLE
  lkao_number_type index_type;     // LKAO_UINT16, LKAO_UINT32 or LKAO_INT32
  const void* indices;             // three numbers a triangle; NULL where there are none
  size_t triangle_count;
  size_t triangle_stride;
  // With LKAO_DOUBLE: taken away from every position, for scenes far from zero (lkao_choose_origin). Receivers must be
  // given less it, too.
  double origin[3];
} lkao_mesh;
#define LKAO_MESH_INIT                                                                    \
  {                                                                                       \
    sizeof(lkao_mesh), NULL, 0, 0, LKAO_FLOAT, LKAO_UINT32, NULL, 0, 0, { 0.0, 0.0, 0.0 } \
  }

// An axis-aligned box; empty where lower > upper.
typedef struct lkao_bounds {
  float lower[3];
  float upper[3];
} lkao_bounds;

// Whether a ray is blocked where it meets a triangle with holes, at (1 - u - v) a + u b + v c of its corners (not 0) or
// passes (0); the same every time (lkao/cut_outs.h). Called in the middle of queries, as long as there are any, from
// all their threads at once.
typedef int (*lkao_cut_out_filter)(void* user, uint32_t instance, uint32_t primitive, float u, float v);

// What a filter says of all points of a part of a triangle.
typedef int32_t lkao_cut_out_part;
enum {
  LKAO_CUT_OUT_MIXED = 0,  // this here and that there, or nobody knows
  LKAO_CUT_OUT_CLEAR = 1,  // that no ray is blocked
  LKAO_CUT_OUT_OPAQUE = 2  // that every ray is blocked
};

// What the filter says of the points of a triangle with u0 <= u <= u0 + size and v0 <= v <= v0 + size, whatever the
// instance. What is wrong here is wrong in queries; what is none of the three is LKAO_ERROR_INVALID_ARGUMENT of the
// build. Called in builds, and refits that build anew, from all their threads at once; not in queries.
typedef lkao_cut_out_part (*lkao_cut_out_survey)(void* user, uint32_t primitive, float u0, float v0, float size);

typedef struct lkao_build_options {
  size_t size;
  int32_t spatial_splits;  // 0 or 1: cut long triangles; faster queries, 3 to 6 times as long to build
  int32_t keep_zero_area;  // 0 or 1: keep triangles without area, for a mesh that shall stand elsewhere (lkao_scene)
  lkao_mesh_storage mesh_storage;
  int32_t thread_count;    // 0: as many as oneTBB gives the calling thread; never more than it has
  lkao_progress progress;  // NULL: none
  void* progress_user;
  // Triangles with holes: those whose opacity is below 1; with a filter and no opacities, all.
  const float* opacities;  // by primitive, from 0 to 1, packed; NULL: none
  size_t opacity_count;
  lkao_cut_out_filter cut_out_filter;  // NULL: a ray is blocked with the opacity's probability
  void* cut_out_user;                  // for the filter and the survey
  // Spares most rays the filter: triangles with holes are looked at beforehand, square by square, and where one is all
  // clear or all opaque nothing is asked. The same masks, of leaves 1.5 to 3 times as fast (bvh/README.md).
  lkao_cut_out_survey cut_out_survey;  // NULL: every ray asks; otherwise there must be a filter
  // For the survey, by primitive: triangles of the same number have the same holes, of which it is asked once.
  const uint32_t* cut_out_looks;  // packed; NULL: each has its own
  size_t cut_out_look_count;
} lkao_build_options;
#define LKAO_BUILD_OPTIONS_INIT \
  { sizeof(lkao_build_options), 1, 0, LKAO_STORAGE_COPY, 0, NULL, NULL, NULL, 0, NULL, NULL, NULL, NULL, 0 }

// What the build found and made. Every triangle of the mesh is an occluder or counted as dropped.
typedef struct lkao_build_report {
  size_t size;
  size_t triangle_count;    // in the mesh
  size_t occluder_count;    // that can block rays
  size_t zero_area_count;   // dropped: corners on one line, or two corners equal
  size_t non_finite_count;  // dropped: a corner with a coordinate that is NaN or beyond 1e18
  size_t reference_count;   // leaf entries, occluder_count plus those made by spatial splits
  size_t node_count;
  size_t memory_bytes;
  double seconds;
  double surface_area_cost;  // nodes and leaves that a long ray is expected to visit
  double growth;             // that over what it was at the build: 1 after a build, usually more after a refit
} lkao_build_report;
#define LKAO_BUILD_REPORT_INIT \
  { sizeof(lkao_build_report), 0, 0, 0, 0, 0, 0, 0, 0.0, 0.0, 0.0 }

typedef struct lkao_refit_options {
  size_t size;
  double max_growth;     // what would grow more is built anew; at least 1, or INFINITY
  int32_t thread_count;  // as of lkao_build_options
  lkao_progress progress;
  void* progress_user;
} lkao_refit_options;
#define LKAO_REFIT_OPTIONS_INIT \
  { sizeof(lkao_refit_options), 2.0, 0, NULL, NULL }

// Builds in parallel. `options` NULL: the defaults. A mesh without any usable triangle is valid and blocks nothing; an
// index that names no position is LKAO_ERROR_INVALID_ARGUMENT.
LKAO_C_API lkao_status lkao_bvh_create(const lkao_mesh* mesh, const lkao_build_options* options, lkao_bvh** bvh);
// The same triangles where their corners have moved to, a fifth of the time of a build (lkao::OccluderBvh::refitted).
// Of `mesh` only positions are read, as many as at the build. `options` NULL: the defaults. lkao_scene_set_mesh puts
// the result into a scene.
LKAO_C_API lkao_status lkao_bvh_create_refitted(const lkao_bvh* bvh, const lkao_mesh* mesh,
                                                const lkao_refit_options* options, lkao_bvh** refitted);
LKAO_C_API lkao_status lkao_bvh_destroy(lkao_bvh* bvh);

LKAO_C_API lkao_status lkao_bvh_get_report(const lkao_bvh* bvh, lkao_build_report* report);
// Of all occluders; lower = +infinity, upper = -infinity where there is none.
LKAO_C_API lkao_status lkao_bvh_get_bounds(const lkao_bvh* bvh, lkao_bounds* bounds);
// What the mesh's positions had taken away.
LKAO_C_API lkao_status lkao_bvh_get_origin(const lkao_bvh* bvh, double origin[3]);

// An origin for a mesh far from zero, near its centre; zero where floats are fine. Reads the positions alone.
LKAO_C_API lkao_status lkao_choose_origin(const lkao_mesh* mesh, double origin[3]);

#ifdef __cplusplus
}
#endif
