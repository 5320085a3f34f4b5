// What share of all directions a receiver sees the sky in, above its surface and below (lkao::SkyVisibility).
#pragma once

#include "lkao/c/ao.h"
#include "lkao/c/batch.h"
#include "lkao/c/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lkao_sky lkao_sky;

typedef struct lkao_sky_options {
  size_t size;
  int32_t ray_count;  // of the whole sphere, rounded up to an even number: 2 to twice LKAO_MAX_RAY_COUNT
  float radius;       // where the sky begins; 0 (the default): INFINITY
  lkao_sidedness sidedness;
  float surface_offset;
  uint64_t seed;
  lkao_kernel kernel;
  int32_t reserved;  // 0
} lkao_sky_options;
#define LKAO_SKY_OPTIONS_INIT \
  { sizeof(lkao_sky_options), 256, 0.0f, LKAO_TWO_SIDED, LKAO_AUTOMATIC_SURFACE_OFFSET, 0, LKAO_SIMD, 0 }

// Shares of solid angle, 0 to 1; NaN where the receiver is invalid.
typedef struct lkao_sky_shares {
  float visibility;  // of the whole sphere
  float above;       // of the hemisphere on the side of the geometric normal
  float below;       // of the other one
} lkao_sky_shares;

// `options` NULL: the defaults.
LKAO_C_API lkao_status lkao_sky_create(const lkao_scene* scene, const lkao_sky_options* options, lkao_sky** sky);
LKAO_C_API lkao_status lkao_sky_destroy(lkao_sky* sky);

// As lkao_ao_query and lkao_ao_query_batch; of a batch, the shares of receivers lie `stride` bytes apart (0: packed).
LKAO_C_API lkao_status lkao_sky_query(const lkao_sky* sky, const lkao_receiver* receiver, uint64_t index,
                                      lkao_sky_shares* shares);
LKAO_C_API lkao_status lkao_sky_query_batch(const lkao_sky* sky, const lkao_receivers* receivers,
                                            lkao_sky_shares* shares, size_t stride, const lkao_batch_options* options,
                                            lkao_query_report* report);

#ifdef __cplusplus
}
#endif
