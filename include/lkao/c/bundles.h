// Bundles: which of any rays of a common origin are blocked (lkao::RayBundles).
#pragma once

#include "lkao/c/ao.h"
#include "lkao/c/batch.h"
#include "lkao/c/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lkao_bundles lkao_bundles;

// Segments from `origin` to origin + rays[i], in world space: three floats each, `ray_stride` bytes apart (0: packed),
// LKAO_MIN_RAY_COUNT to LKAO_MAX_RAY_COUNT of them.
typedef struct lkao_bundle {
  size_t size;
  const float* rays;
  size_t ray_stride;
  size_t ray_count;
  float origin[3];
  uint32_t excluded_primitive;  // cannot block them; LKAO_NO_PRIMITIVE: none
  uint32_t excluded_instance;   // whose primitive that is
  uint32_t occluder_groups;     // only instances that share a group with it block them
} lkao_bundle;
#define LKAO_BUNDLE_INIT \
  { sizeof(lkao_bundle), NULL, 0, 0, {0.0f, 0.0f, 0.0f}, LKAO_NO_PRIMITIVE, 0, LKAO_ALL_GROUPS }

LKAO_C_API lkao_status lkao_bundles_create(const lkao_scene* scene, lkao_sidedness sidedness, lkao_kernel kernel,
                                           lkao_bundles** bundles);
LKAO_C_API lkao_status lkao_bundles_destroy(lkao_bundles* bundles);

// One bundle, in the calling thread. Bit i % 64 of word i / 64: ray i is blocked. `word_count` is the length of `mask`,
// at least LKAO_WORD_COUNT(bundle->ray_count): words beyond that become 0.
LKAO_C_API lkao_status lkao_bundles_blocked(const lkao_bundles* bundles, const lkao_bundle* bundle, uint64_t* mask,
                                            size_t word_count);

// Many, in parallel: an array of structs of batch[0].size bytes each. Masks begin `mask_stride` bytes apart and have
// `word_count` words each, as above. Of `options`, which may be NULL, first_index is of no account, and progress counts
// bundles.
LKAO_C_API lkao_status lkao_bundles_blocked_batch(const lkao_bundles* bundles, const lkao_bundle* batch, size_t count,
                                                  uint64_t* masks, size_t mask_stride, size_t word_count,
                                                  const lkao_batch_options* options);

LKAO_C_API lkao_status lkao_scene_create_of_bundles(const lkao_bundles* bundles, lkao_scene** scene);

#ifdef __cplusplus
}
#endif
