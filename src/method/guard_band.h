// A picture with a margin: pixels around those that are wanted, which block and are thrown away.
#pragma once

#include <vector>

#include "scene/camera.h"

namespace lkao::method {

struct GuardedView {
  scene::Camera camera;
  scene::ReceiverImage image;
};

// What a camera sees with `margin` more pixels on each side; in the middle the very receivers of `image`. Throws as
// scene::find_receivers() does.
GuardedView widen(const scene::Mesh& mesh, const scene::Camera& camera, const scene::ReceiverImage& image, int margin);

// The middle of a frame that was drawn of such a view.
std::vector<float> without_margin(const std::vector<float>& frame, int width, int margin);

}  // namespace lkao::method
