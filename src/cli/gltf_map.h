// The image that a baked map becomes in a glTF.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/gltf_writer.h"

namespace lkao::cli {

// The bytes of a PNG file whose R is the visibility, 1 - occlusion; row by row from the top, black where occlusion is
// NaN. Without `packed`, it is grey. Otherwise they are those of that image, and the result has the larger
// width and the larger height of both: what is smaller is interpolated. `name` is what messages name. Throws
// std::runtime_error with one line where the packed image cannot be read.
std::string make_map_png(int width, int height, const std::vector<float>& occlusion,
                         const std::optional<scene::PackedImage>& packed, const std::string& name);

}  // namespace lkao::cli
