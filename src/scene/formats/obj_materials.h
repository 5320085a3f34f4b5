// The material files that an OBJ file names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lkao::scene {

// Names of the materials of an MTL text that let light through: a map of opacity, or an opacity below one. Whatever
// else is in the text is passed over.
std::vector<std::string> see_through_materials(std::string_view text);

}  // namespace lkao::scene
