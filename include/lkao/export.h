// LKAO_API: what a shared library shows. All other names stay inside, and so do all names of a static library that ends
// up in a shared object of its user: two versions of lkao may live in one process. In the headers of lut/ it marks what
// the other libraries of lkao call.
#pragma once

// LKAO_SHARED is defined by the targets of a shared lkao, for itself and for its users.
#if !defined(LKAO_SHARED)
#define LKAO_API
#elif defined(_WIN32) && defined(LKAO_BUILDING)
#define LKAO_API __declspec(dllexport)
#elif defined(_WIN32)
#define LKAO_API __declspec(dllimport)
#else
#define LKAO_API __attribute__((visibility("default")))
#endif
