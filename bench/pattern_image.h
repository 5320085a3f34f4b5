// Pictures in which structure between neighbouring receivers would show.
#pragma once

#include <string>

#include "image/image.h"

namespace lkao::bench {

// A built-in scene, near by: a column for every kind of pattern, from the left as PatternKind lists them; the rows are
// 64 rays turned by any angle, 128 rays turned so, 64 rays turned by up to an eighth, and 64 rays not turned at all.
// Throws std::runtime_error for an unknown scene.
image::Image pattern_image(const std::string& builtin_scene);

}  // namespace lkao::bench
