// The alpha of image files, for holes in a scene.
#pragma once

#include <string>
#include <string_view>

#include "scene/holes.h"

namespace lkao::cli {

// As scene::DecodeAlpha.
scene::AlphaImage decode_alpha(const std::string& name, std::string_view bytes, scene::AlphaOf what);

}  // namespace lkao::cli
