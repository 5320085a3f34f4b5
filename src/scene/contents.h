// What a scene's file holds besides triangles.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lkao::scene {

struct Contents {
  std::size_t node_count = 0;      // places in the scene that show a mesh; 0 where the format knows none
  std::size_t instance_count = 0;  // meshes as often as they are shown
  std::size_t hidden_count = 0;    // nodes that are not shown, by the file's own word
  std::size_t uv_set_count = 0;    // most texture coordinates that a vertex has
  std::size_t cut_out_count = 0;   // triangles of a material with holes by transparency: they block as if whole
  std::vector<std::string> materials =
      {};  // their names, where texture coordinates were asked for; those without have ""
  // One line each, in words: what the file says, is not obeyed, and changes occlusion.
  std::vector<std::string> remarks;
};

}  // namespace lkao::scene
