// Sample patterns: which shadow rays a receiver casts (lkao::SamplePattern).
#pragma once

#include "lkao/c/falloff.h"
#include "lkao/c/status.h"

#define LKAO_MIN_RAY_COUNT 1
#define LKAO_MAX_RAY_COUNT 1024
// 64-bit words of a mask of so many rays.
#define LKAO_WORD_COUNT(ray_count) (((ray_count) + 63) / 64)
#define LKAO_MAX_WORD_COUNT 16

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lkao_pattern lkao_pattern;

// How directions are spread (lkao/pattern_kind.h compares the kinds).
typedef int32_t lkao_pattern_kind;
enum {
  LKAO_PATTERN_LLOYD = 0,  // the default
  LKAO_PATTERN_PAPER = 1,
  LKAO_PATTERN_FIBONACCI = 2,
  LKAO_PATTERN_SOBOL = 3,
  LKAO_PATTERN_RANDOM = 4
};

// How densely directions are spread over the hemisphere (lkao/weighting.h).
typedef int32_t lkao_weighting;
enum {
  LKAO_COSINE = 0,  // by the cosine of the angle to the normal: ambient occlusion as renderers define it
  LKAO_UNIFORM = 1  // evenly by solid angle
};

typedef struct lkao_pattern_options {
  size_t size;
  lkao_pattern_kind kind;
  int32_t ray_count;  // LKAO_MIN_RAY_COUNT to LKAO_MAX_RAY_COUNT
  uint64_t seed;
  lkao_weighting weighting;
  const lkao_falloff* falloff;  // NULL: constant
} lkao_pattern_options;
#define LKAO_PATTERN_OPTIONS_INIT \
  { sizeof(lkao_pattern_options), LKAO_PATTERN_LLOYD, 128, 0, LKAO_COSINE, NULL }

// The same options, the same pattern. Takes milliseconds for 128 rays, some tenths of a second for 1024.
LKAO_C_API lkao_status lkao_pattern_create(const lkao_pattern_options* options, lkao_pattern** pattern);

// The default pattern of that count and weighting, of seed 0 and constant falloff. Made at the first call and kept for
// the life of the process; later ones cost nothing.
LKAO_C_API lkao_status lkao_pattern_create_standard(int32_t ray_count, lkao_weighting weighting,
                                                    lkao_pattern** pattern);

// A pattern of the caller's own: points (x, y) inside the unit disk, two floats each, and lengths in [0, 1], one each.
// Strides are in bytes; 0: packed.
LKAO_C_API lkao_status lkao_pattern_create_from_disk(const float* points, size_t point_stride, const float* lengths,
                                                     size_t length_stride, int32_t ray_count, lkao_pattern** pattern);

// The same directions, with ray lengths distributed after another falloff.
LKAO_C_API lkao_status lkao_pattern_create_with_falloff(const lkao_pattern* pattern, const lkao_falloff* falloff,
                                                        lkao_pattern** result);

LKAO_C_API lkao_status lkao_pattern_destroy(lkao_pattern* pattern);

// 0 where the handle is none (see lkao_last_error).
LKAO_C_API int32_t lkao_pattern_ray_count(const lkao_pattern* pattern);
LKAO_C_API int32_t lkao_pattern_word_count(const lkao_pattern* pattern);

// Arrays of the pattern, packed, one entry a ray, which live as long as the handle; NULL where that is none. Points on
// the unit disk, two floats each; unit directions with z > 0, three floats each; lengths in [0, 1], one float each.
LKAO_C_API const float* lkao_pattern_disk(const lkao_pattern* pattern);
LKAO_C_API const float* lkao_pattern_directions(const lkao_pattern* pattern);
LKAO_C_API const float* lkao_pattern_lengths(const lkao_pattern* pattern);

// Elevation of the lowest ray above the horizon, in radians.
LKAO_C_API lkao_status lkao_pattern_lowest_elevation(const lkao_pattern* pattern, float* elevation);

// "lloyd", "paper", "fibonacci", "sobol", "random"; NULL for other numbers.
LKAO_C_API const char* lkao_pattern_kind_name(lkao_pattern_kind kind);
LKAO_C_API lkao_status lkao_pattern_kind_named(const char* name, lkao_pattern_kind* kind);

#ifdef __cplusplus
}
#endif
