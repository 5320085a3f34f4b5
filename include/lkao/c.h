// lkao for C, and for all that calls C: this header brings in the whole C interface; link lkao::c (liblkao_c.so).
//
//   lkao_mesh mesh = LKAO_MESH_INIT;
//   mesh.positions = positions, mesh.position_count = position_count;
//   mesh.indices = indices, mesh.triangle_count = triangle_count;
//   lkao_ray_options rays = LKAO_RAY_OPTIONS_INIT;
//   rays.radius = 2;
//   lkao_scene* scene = NULL;
//   lkao_pattern* pattern = NULL;
//   lkao_ao* ao = NULL;
//   if (lkao_scene_create(&mesh, NULL, &scene) || lkao_pattern_create_standard(128, LKAO_COSINE, &pattern) ||
//       lkao_ao_create(scene, pattern, &rays, LKAO_SIMD, &ao)) {
//     fprintf(stderr, "%s\n", lkao_last_error());
//   }
//   lkao_ao_query(ao, &receiver, pixel, &answer);
//
// Words, spaces, units and results are those of the C++ interface, and the answers are its answers, bit for bit: what a
// function means in depth, and what it costs, is said at its twin in lkao.h and what that includes.
//
// Handles   are opaque, made by lkao_*_create* and given back to lkao_*_destroy, which takes NULL, too. An object keeps
//           what it was made of: a mesh's arrays and a scene's handle may go once the lkao_ao is made. A handle that is
//           NULL, was destroyed, is of another kind, or was never one, is answered with LKAO_ERROR_INVALID_HANDLE and a
//           message: handles are numbers that the library looks up, and never addresses that it follows. On 32-bit
//           machines that is found out in nearly all cases.
// Errors    Functions return a lkao_status, LKAO_OK = 0; lkao_last_error() tells what was wrong, naming function,
//           argument and value. Of what a failed function should have written, a new handle becomes NULL and all else
//           stays as it was, but for the arrays of a batch that was cancelled. No C++ exception leaves a function,
//           nothing is printed, nothing aborts.
// Structs   that may grow begin with their size. Fill them from their LKAO_*_INIT, which sets the size and the
//           defaults: zero is a value and no default. A smaller size is a caller of older headers: members that it does
//           not know have their defaults. Of a larger size, bytes that this library does not know must be zero
//           (LKAO_ERROR_UNSUPPORTED). Into structs that it fills, the library writes no more than their size.
// Threads   A handle may be used by any number of threads at once; lkao_neighbourhood, and a lkao_scene that is
//           changed, by one at a time. Destroying is using: nobody else may use the handle then, or later. Builds and
//           batches run in parallel on oneTBB's threads, on as many as `thread_count` says. Results do not depend on
//           it.
// Callbacks are called from any of these threads, one call at a time but for lkao_cut_out_filter and
//           lkao_cut_out_survey, and get the `user` pointer that was given with them. They may call the interface, but
//           must neither throw nor jump out.
//
// The promise of its ABI: for as long as the library is called liblkao_c.so.0, a program that was compiled with older
// headers of that name runs, unchanged, with a newer library. No function goes and none changes its arguments; numbers
// of enumerations stay; structs only grow at their end. tests/c_api/abi.txt lists all of it, and a test holds the
// library to the list.
#pragma once

#include "lkao/c/ao.h"
#include "lkao/c/batch.h"
#include "lkao/c/bundles.h"
#include "lkao/c/bvh.h"
#include "lkao/c/falloff.h"
#include "lkao/c/isa.h"
#include "lkao/c/neighbourhood.h"
#include "lkao/c/pattern.h"
#include "lkao/c/scene.h"
#include "lkao/c/shadows.h"
#include "lkao/c/sky.h"
#include "lkao/c/status.h"
#include "lkao/c/table.h"
