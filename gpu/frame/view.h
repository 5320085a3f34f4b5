// From a camera to what the shaders need of it.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "gpu/frame/view_block.h"
#include "lkao/gl/frame.h"

namespace lkao::gl {

// What a pass answers of width x height pixels: every step-th along each axis.
struct Pixels {
  int width, height, step = 1;
};

// The camera's part of the block, and the size. Throws std::invalid_argument where `view` is no rigid motion or
// `projection` neither perspective nor orthographic.
ViewBlock make_view_block(const Camera& camera, const Pixels& pixels);

// Into the clip space of a screen that shows the answered pixels alone, side by side: their centres are where the
// camera sees those of the pixels that they stand for.
glm::dmat4 clip_from_world(const Camera& camera, const Pixels& pixels);

// Distances along the view at which the depth range of an orthographic camera begins and ends.
struct DepthEnds {
  double nearest, farthest;
};
DepthEnds orthographic_depth_ends(const Camera& camera);

// Runs the compute program in use, whose groups are of 8 x 8 pixels, over all of them.
void dispatch_over_pixels(int width, int height);

// True where the screen shows the world mirrored, so that fronts of triangles run clockwise.
bool is_mirrored(const Camera& camera);

}  // namespace lkao::gl
