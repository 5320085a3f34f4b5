// Many receivers at once, in parallel (the other lkao::AmbientOcclusion::query).
#pragma once

#include "lkao/c/ao.h"
#include "lkao/c/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// Receivers in the caller's arrays, of any layout. Strides are in bytes; 0: packed.
typedef struct lkao_receivers {
  size_t size;
  size_t count;
  const float* positions;  // three floats each
  size_t position_stride;
  const float* normals;  // three floats each
  size_t normal_stride;
  const float* geometric_normals;  // three floats each; NULL: the same as the normals
  size_t geometric_normal_stride;
  const uint32_t* excluded_primitives;  // one each; NULL: none
  size_t excluded_primitive_stride;
  const uint32_t* excluded_instances;  // one each; NULL: 0
  size_t excluded_instance_stride;
  const uint32_t* occluder_groups;  // one each; NULL: LKAO_ALL_GROUPS
  size_t occluder_group_stride;
} lkao_receivers;
#define LKAO_RECEIVERS_INIT \
  { sizeof(lkao_receivers), 0, NULL, 0, NULL, 0, NULL, 0, NULL, 0, NULL, 0, NULL, 0 }

// Where the answers go: arrays with an entry for each receiver, or NULL where one is not wanted. They may lie between
// other data of the caller, which stays, but must not overlap each other.
typedef struct lkao_outputs {
  size_t size;
  float* occlusion;  // one each
  size_t occlusion_stride;
  float* bent_normals;  // three floats each
  size_t bent_normal_stride;
  uint64_t* masks;  // lkao_pattern_word_count() words each
  size_t mask_stride;
} lkao_outputs;
#define LKAO_OUTPUTS_INIT \
  { sizeof(lkao_outputs), NULL, 0, NULL, 0, NULL, 0 }

typedef struct lkao_batch_options {
  size_t size;
  uint64_t first_index;    // receiver k has the index first_index + k
  int32_t thread_count;    // 0: as many as oneTBB gives the calling thread; 1: the calling thread alone
  lkao_progress progress;  // counts receivers; NULL: none
  void* progress_user;
} lkao_batch_options;
#define LKAO_BATCH_OPTIONS_INIT \
  { sizeof(lkao_batch_options), 0, 0, NULL, NULL }

typedef struct lkao_query_report {
  size_t size;
  size_t receiver_count;
  size_t invalid_receiver_count;  // answered with NaN
  uint64_t ray_count;             // cast
  uint64_t blocked_ray_count;
} lkao_query_report;
#define LKAO_QUERY_REPORT_INIT \
  { sizeof(lkao_query_report), 0, 0, 0, 0 }

// `options` and `report` may be NULL. Where `progress` stops it, some entries of the outputs are answers, and the
// others are what they were. It keeps some megabytes while it runs, whatever the number of receivers.
LKAO_C_API lkao_status lkao_ao_query_batch(const lkao_ao* ao, const lkao_receivers* receivers,
                                           const lkao_outputs* outputs, const lkao_batch_options* options,
                                           lkao_query_report* report);

#ifdef __cplusplus
}
#endif
