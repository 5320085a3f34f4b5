// Falloff: how much an occluder at some distance darkens (lkao::Falloff).
#pragma once

#include "lkao/c/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// rho(x), where x is a share of the AO radius: 1 = as much as a touching occluder, 0 = not at all.
typedef int32_t lkao_falloff_kind;
enum {
  LKAO_FALLOFF_CONSTANT = 0,     // 1 up to the radius
  LKAO_FALLOFF_LINEAR = 1,       // 1 - x
  LKAO_FALLOFF_SMOOTH = 2,       // 1 - 3x^2 + 2x^3
  LKAO_FALLOFF_EXPONENTIAL = 3,  // (exp(-rate x) - exp(-rate)) / (1 - exp(-rate))
  LKAO_FALLOFF_CUSTOM = 4        // the caller's function
};

// Any function of x in [0, 1] with values in [0, 1] that never rises. It is called while the call runs that was given
// it, in the calling thread, and not later.
typedef double (*lkao_falloff_function)(void* user, double x);

typedef struct lkao_falloff {
  size_t size;
  lkao_falloff_kind kind;
  double rate;  // exponential: in (0, 100]
  lkao_falloff_function function;
  void* user;
} lkao_falloff;
#define LKAO_FALLOFF_INIT \
  { sizeof(lkao_falloff), LKAO_FALLOFF_CONSTANT, 4.0, NULL, NULL }

// rho(x) for x in [0, 1].
LKAO_C_API lkao_status lkao_falloff_value(const lkao_falloff* falloff, double x, double* value);

// The largest x in [0, 1] with rho(x) >= u: the length of a ray whose share of longer rays is u, in [0, 1].
LKAO_C_API lkao_status lkao_falloff_length_at(const lkao_falloff* falloff, double u, double* length);

// "constant", "linear", "smooth", "exponential" and "custom"; NULL for other numbers.
LKAO_C_API const char* lkao_falloff_kind_name(lkao_falloff_kind kind);
LKAO_C_API lkao_status lkao_falloff_kind_named(const char* name, lkao_falloff_kind* kind);

#ifdef __cplusplus
}
#endif
