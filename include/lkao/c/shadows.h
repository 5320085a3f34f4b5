// Soft shadows: what share of a light a receiver sees (lkao::SoftShadows).
#pragma once

#include "lkao/c/ao.h"
#include "lkao/c/batch.h"
#include "lkao/c/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lkao_shadows lkao_shadows;

typedef int32_t lkao_light_kind;
enum {
  LKAO_LIGHT_DISC = 0,   // flat, seen from both sides: what counts of it is area
  LKAO_LIGHT_SPHERE = 1  // what counts of it is solid angle
};

typedef struct lkao_light {
  size_t size;
  lkao_light_kind kind;
  float position[3];  // of the centre
  float normal[3];    // of a disc, of any length but 0
  float radius;       // > 0
} lkao_light;
#define LKAO_LIGHT_INIT \
  { sizeof(lkao_light), LKAO_LIGHT_DISC, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, 0.0f }

typedef struct lkao_shadow_options {
  size_t size;
  lkao_sidedness sidedness;
  float rotation;  // of the light's points from receiver to receiver, in turns, 0 to 1
  uint64_t seed;   // with a receiver's index, the only source of its turn
  float surface_offset;
  lkao_kernel kernel;
} lkao_shadow_options;
#define LKAO_SHADOW_OPTIONS_INIT \
  { sizeof(lkao_shadow_options), LKAO_TWO_SIDED, 1.0f, 0, LKAO_AUTOMATIC_SURFACE_OFFSET, LKAO_SIMD }

typedef struct lkao_visibility {
  size_t size;
  uint64_t mask[LKAO_MAX_WORD_COUNT];  // bit i % 64 of word i / 64: the ray to point i of the light is blocked
  float visibility;                    // share of the light that is seen; NaN where the receiver is invalid
  float above_horizon;                 // share of the light above the receiver's horizon
} lkao_visibility;
#define LKAO_VISIBILITY_INIT \
  { sizeof(lkao_visibility), {0}, 0.0f, 0.0f }

// As lkao_outputs.
typedef struct lkao_shadow_outputs {
  size_t size;
  float* visibility;
  size_t visibility_stride;
  float* above_horizon;
  size_t above_horizon_stride;
  uint64_t* masks;  // lkao_pattern_word_count() words each
  size_t mask_stride;
} lkao_shadow_outputs;
#define LKAO_SHADOW_OUTPUTS_INIT \
  { sizeof(lkao_shadow_outputs), NULL, 0, NULL, 0, NULL, 0 }

// The light's points are those of the pattern's disk. `options` NULL: the defaults.
LKAO_C_API lkao_status lkao_shadows_create(const lkao_scene* scene, const lkao_light* light,
                                           const lkao_pattern* pattern, const lkao_shadow_options* options,
                                           lkao_shadows** shadows);
LKAO_C_API lkao_status lkao_shadows_destroy(lkao_shadows* shadows);

// As lkao_ao_query, lkao_ao_query_batch and lkao_ao_get_rays.
LKAO_C_API lkao_status lkao_shadows_query(const lkao_shadows* shadows, const lkao_receiver* receiver, uint64_t index,
                                          lkao_visibility* visibility);
LKAO_C_API lkao_status lkao_shadows_query_batch(const lkao_shadows* shadows, const lkao_receivers* receivers,
                                                const lkao_shadow_outputs* outputs, const lkao_batch_options* options,
                                                lkao_query_report* report);
LKAO_C_API lkao_status lkao_shadows_get_rays(const lkao_shadows* shadows, const lkao_receiver* receiver, uint64_t index,
                                             lkao_rays* rays, float* segments, size_t segment_stride);

LKAO_C_API lkao_status lkao_scene_create_of_shadows(const lkao_shadows* shadows, lkao_scene** scene);
LKAO_C_API lkao_status lkao_pattern_create_of_shadows(const lkao_shadows* shadows, lkao_pattern** pattern);
LKAO_C_API lkao_status lkao_shadows_get_light(const lkao_shadows* shadows, lkao_light* light);
// All but the kernel, which stays as it is.
LKAO_C_API lkao_status lkao_shadows_get_options(const lkao_shadows* shadows, lkao_shadow_options* options);

#ifdef __cplusplus
}
#endif
