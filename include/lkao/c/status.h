// What every function of the C interface answers.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "lkao/version_numbers.h"

// What liblkao_c shows.
#if !defined(_WIN32)
#define LKAO_C_API __attribute__((visibility("default")))
#elif defined(LKAO_C_BUILDING)
#define LKAO_C_API __declspec(dllexport)
#else
#define LKAO_C_API __declspec(dllimport)
#endif

// The number in the library's name, liblkao_c.so.0: see the promise in lkao/c.h.
#define LKAO_C_ABI 0

#ifdef __cplusplus
extern "C" {
#endif

typedef int32_t lkao_status;
enum {
  LKAO_OK = 0,
  LKAO_ERROR_INVALID_ARGUMENT = 1,  // out of range, or NULL where something is needed
  LKAO_ERROR_INVALID_HANDLE = 2,    // NULL, destroyed, of another kind, or never a handle
  LKAO_ERROR_UNSUPPORTED = 3,       // a struct has members set that this library does not know
  LKAO_ERROR_OUT_OF_MEMORY = 4,
  LKAO_ERROR_CANCELLED = 5,  // the caller's lkao_progress stopped the call
  LKAO_ERROR_INTERNAL = 6    // anything else: a bug of lkao, or an exception out of a callback
};

// "LKAO_OK" and so on; "unknown status" for other numbers.
LKAO_C_API const char* lkao_status_name(lkao_status status);

// What was wrong with the last call that failed in this thread, in one line; "" where none did. Calls that succeed
// leave it. The text stays until the next call fails in this thread.
LKAO_C_API const char* lkao_last_error(void);

// Of the library that is linked, "0.1.0".
LKAO_C_API const char* lkao_version(void);

// How many handles of all kinds exist: 0 at the end of a program that destroyed all that it created. Leak checkers do
// not tell, as the library itself can reach all of them.
LKAO_C_API size_t lkao_live_handle_count(void);

// Told now and then how much of a call's work is done, of how much: receivers of a batch, triangles of a build. Returns
// 0 to stop the call, which then ends with LKAO_ERROR_CANCELLED; anything else lets it go on.
typedef int (*lkao_progress)(void* user, size_t done, size_t total);

#ifdef __cplusplus
}
#endif
