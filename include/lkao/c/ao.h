// The query: which shadow rays of a receiver are blocked (lkao::AmbientOcclusion).
#pragma once

#include "lkao/c/pattern.h"
#include "lkao/c/scene.h"
#include "lkao/c/status.h"
#include "lkao/c/table.h"

#define LKAO_NO_PRIMITIVE 0xffffffffu
#define LKAO_AUTOMATIC_SURFACE_OFFSET (-1.0f)
// What the query takes where the offset is automatic.
#define LKAO_QUERY_SURFACE_OFFSET 16.0f

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lkao_ao lkao_ao;

typedef int32_t lkao_sidedness;
enum {
  LKAO_TWO_SIDED = 0,  // a triangle blocks rays from both sides
  LKAO_ONE_SIDED = 1   // a triangle blocks rays only of receivers in front of it
};

// What answers ray by ray; the bits are the same.
typedef int32_t lkao_kernel;
enum { LKAO_SIMD = 0, LKAO_SCALAR = 1 };

// How look-ups find the rays that may meet a node (lkao/kernel.h).
typedef int32_t lkao_node_masks;
enum { LKAO_NODES_BOUNDING_SPHERE = 0, LKAO_NODES_BOX_OUTLINE = 1 };

// The rays of every receiver and what they meet (lkao::RayOptions says more of each member).
typedef struct lkao_ray_options {
  size_t size;
  float radius;  // AO radius: > 0, at most 1e18, or INFINITY. Has no default
  lkao_sidedness sidedness;
  float jitter_rotation;  // about the normal, in turns, 0 to 1
  float jitter_tilt;      // of the pattern's axis, in radians, 0 to pi/2
  uint64_t seed;          // with a receiver's index, the only source of its jitter
  float surface_offset;   // in steps of 2^-24 of the largest coordinate; >= 0, or automatic
  float min_distance;     // where rays begin to count; >= 0 and less than the radius
} lkao_ray_options;
#define LKAO_RAY_OPTIONS_INIT \
  { sizeof(lkao_ray_options), 0.0f, LKAO_TWO_SIDED, 1.0f, 0.0f, 0, LKAO_AUTOMATIC_SURFACE_OFFSET, 0.0f }

// Occluders that block rays only where their distance is in [r_min, r_max]: a level of detail.
typedef struct lkao_level {
  size_t size;
  const lkao_scene* scene;
  float r_min;
  float r_max;
} lkao_level;
// r_max has no default: up to where the next level begins; INFINITY for the last.
#define LKAO_LEVEL_INIT \
  { sizeof(lkao_level), NULL, 0.0f, 0.0f }

// A point that receives occlusion.
typedef struct lkao_receiver {
  size_t size;
  float position[3];
  float normal[3];              // the axis of the sample pattern, of any length
  float geometric_normal[3];    // rays below its horizon are not cast; zero: the same as `normal`
  uint32_t excluded_primitive;  // cannot block this receiver's rays; LKAO_NO_PRIMITIVE: none
  uint32_t excluded_instance;   // whose primitive that is
  uint32_t occluder_groups;     // only instances that share a group with it block its rays
} lkao_receiver;
#define LKAO_RECEIVER_INIT                                                                                   \
  {                                                                                                          \
    sizeof(lkao_receiver), {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, LKAO_NO_PRIMITIVE, 0, \
        LKAO_ALL_GROUPS                                                                                      \
  }

typedef struct lkao_answer {
  size_t size;
  uint64_t mask[LKAO_MAX_WORD_COUNT];  // bit i % 64 of word i / 64: ray i is blocked
  float occlusion;                     // share of the cast rays that are blocked; NaN where the receiver is invalid
  float bent_normal[3];                // mean direction of the cast rays that are not blocked, a unit vector
} lkao_answer;
#define LKAO_ANSWER_INIT                                 \
  {                                                      \
    sizeof(lkao_answer), {0}, 0.0f, { 0.0f, 0.0f, 0.0f } \
  }

// The rays that a receiver casts (lkao::ReceiverRays).
typedef struct lkao_rays {
  size_t size;
  float origin[3];
  float frame[9];                      // column by column: where the pattern's axes go
  float up[3];                         // the geometric normal, a unit vector
  uint64_t cast[LKAO_MAX_WORD_COUNT];  // bit i % 64 of word i / 64: ray i is above the horizon, and cast
  float radius;
  int32_t ray_count;
} lkao_rays;
#define LKAO_RAYS_INIT \
  { sizeof(lkao_rays), {0.0f, 0.0f, 0.0f}, {0.0f}, {0.0f, 0.0f, 0.0f}, {0}, 0.0f, 0 }

LKAO_C_API lkao_status lkao_ao_create(const lkao_scene* scene, const lkao_pattern* pattern,
                                      const lkao_ray_options* options, lkao_kernel kernel, lkao_ao** ao);
// Several levels of detail, near ones first is fastest. They are an array of structs of levels[0].size bytes each.
LKAO_C_API lkao_status lkao_ao_create_levels(const lkao_level* levels, size_t level_count, const lkao_pattern* pattern,
                                             const lkao_ray_options* options, lkao_kernel kernel, lkao_ao** ao);
// By the paper's look-ups instead of ray by ray; the pattern is the table's.
LKAO_C_API lkao_status lkao_ao_create_by_table(const lkao_scene* scene, const lkao_table* table,
                                               const lkao_ray_options* options, lkao_node_masks node_masks,
                                               lkao_ao** ao);
LKAO_C_API lkao_status lkao_ao_destroy(lkao_ao* ao);

// One receiver, in the calling thread. `index` with the seed gives the jitter: use the pixel, the vertex or the sample
// number. Needs 120 KiB of stack, and 2.5 KiB more for each level of nodes in the hierarchy (some 10).
LKAO_C_API lkao_status lkao_ao_query(const lkao_ao* ao, const lkao_receiver* receiver, uint64_t index,
                                     lkao_answer* answer);

// The mask alone. `word_count` is the length of `mask`, at least lkao_pattern_word_count(): words beyond that become 0.
LKAO_C_API lkao_status lkao_ao_blocked(const lkao_ao* ao, const lkao_receiver* receiver, uint64_t index, uint64_t* mask,
                                       size_t word_count);

// The rays that a query casts for this receiver, bit for bit. Into `rays`, unless that is NULL, all but the segments;
// into `segments`, unless that is NULL, direction x length of each ray, three floats each, `segment_stride` bytes apart
// (0: packed), as many as the pattern has.
LKAO_C_API lkao_status lkao_ao_get_rays(const lkao_ao* ao, const lkao_receiver* receiver, uint64_t index,
                                        lkao_rays* rays, float* segments, size_t segment_stride);

LKAO_C_API lkao_status lkao_ao_get_options(const lkao_ao* ao, lkao_ray_options* options);
// New handles of what it was made of. Of levels, the scene is the first one's; by look-ups alone there is a table.
LKAO_C_API lkao_status lkao_pattern_create_of_ao(const lkao_ao* ao, lkao_pattern** pattern);
LKAO_C_API lkao_status lkao_scene_create_of_ao(const lkao_ao* ao, lkao_scene** scene);
LKAO_C_API lkao_status lkao_table_create_of_ao(const lkao_ao* ao, lkao_table** table);

#ifdef __cplusplus
}
#endif
