// The mean of several frames of a noisy pass.
#pragma once

#include <functional>

#include "lkao/gl.h"

namespace lkao::raster {

// `draw(i)` writes frame i to the red channel of `target`, a texture of one float a pixel that is no part of a larger
// one; the mean of all is what it holds in the end.
void draw_mean(int frame_count, const gl::OcclusionTarget& target, int width, int height,
               const std::function<void(int)>& draw);

}  // namespace lkao::raster
