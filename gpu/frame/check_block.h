// What the check of a G-buffer finds. Compiled as C++ and GLSL.
#ifndef LKAO_GPU_FRAME_CHECK_BLOCK_H
#define LKAO_GPU_FRAME_CHECK_BLOCK_H

#ifdef __cplusplus
#include <cstdint>
#define LKAO_UINT std::uint32_t
#else
#define LKAO_UINT uint
#endif

// Pixels of a grid over the picture.
#define LKAO_CHECKED_SIDE 16

// Of those pixels. Floats above 0 as their bits, which have the same order.
#define LKAO_CHECK_RESULTS                                                             \
  LKAO_UINT receiver_count;                                                            \
  LKAO_UINT hit_count;             /* positions at their pixels' centres, nearly */    \
  LKAO_UINT other_space_hit_count; /* taken for positions in the other space */        \
  LKAO_UINT flipped_hit_count;     /* taken for a picture whose rows run downwards */  \
  LKAO_UINT largest_error_bits;    /* what an automatic surface offset adds at most */ \
  LKAO_UINT largest_texel_bits;    /* how far a format may put a component of a position */

#endif
