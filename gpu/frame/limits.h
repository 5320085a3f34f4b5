// Numbers beyond which nothing is counted on. Compiled as C++ and GLSL: only #define and comments here.
#ifndef LKAO_GPU_FRAME_LIMITS_H
#define LKAO_GPU_FRAME_LIMITS_H

// lut::kLargestCoordinate: squares of such coordinates are still floats.
#define LKAO_LARGEST_COORDINATE 1e18

#endif
