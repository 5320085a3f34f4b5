// From a camera to what the shaders need of it.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "gpu/frame/view_block.h"
#include "lkao/gl/frame.h"

namespace lkao::gl {

// The camera's part of the block, and the size. Throws std::invalid_argument where `view` is no rigid motion or
// `projection` neither perspective nor orthographic.
ViewBlock make_view_block(const Camera& camera, int width, int height);

glm::dmat4 clip_from_world(const Camera& camera);

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
