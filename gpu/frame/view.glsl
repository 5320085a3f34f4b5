// What is seen, for all shaders of a frame.
#include "gpu/frame/view_block.h"

bool is_perspective() { return view.is_perspective != 0; }
// At a position in view space.
float pixel_width(vec3 position) { return view.pixel_size * (is_perspective() ? -position.z : 1.0); }
float distance_along_view(vec3 position) { return dot(view.view_depth.xyz, position) + view.view_depth.w; }

// For compute shaders that run in groups of 8 x 8 pixels.
bool is_outside(ivec2 pixel) { return pixel.x >= view.width || pixel.y >= view.height; }
