// The material files that an OBJ file names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

namespace lkao::scene {

// Of "map_d", with its options.
struct ObjOpacityMap {
  std::string name = {};  // of an image file; empty: there is none
  bool clamps = false;    // it is not repeated
  // It is seen at texture coordinates times `scale` plus `offset` ("-s", "-o"), from the image's lower left corner.
  glm::dvec2 scale{1}, offset{0};
  std::vector<std::string> ignored = {};  // options that would change it otherwise
};

// One that lets light through: by an opacity below one, or a map of it.
struct ObjMaterial {
  std::string name;
  double opacity = 1;  // of "d" or "Tr"; from 0 to 1
  ObjOpacityMap map = {};
};

// Those of an MTL text. Whatever else is in the text is passed over.
std::vector<ObjMaterial> see_through_materials(std::string_view text);

}  // namespace lkao::scene
