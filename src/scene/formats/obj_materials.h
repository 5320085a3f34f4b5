// The material files that an OBJ file names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lkao::scene {

// One that lets light through: by an opacity below one, or a map of it.
struct ObjMaterial {
  std::string name;
  double opacity = 1;    // of "d" or "Tr"; from 0 to 1
  std::string map = {};  // of "map_d": the name of an image file; empty: none
  bool clamps = false;   // the map is not repeated
};

// Those of an MTL text. Whatever else is in the text is passed over.
std::vector<ObjMaterial> see_through_materials(std::string_view text);

}  // namespace lkao::scene
