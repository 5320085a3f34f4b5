// Values of texels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace lkao::bake {

// Row by row from the top. Texel (x, y) covers [x, x + 1] x [y, y + 1] of width x height, and is shown at its middle.
struct TextureMap {
  int udim = 0;  // the number of its UDIM tile; 0 where there are none
  int width = 0, height = 0;
  std::vector<float> occlusion;         // NaN where nothing is known
  std::vector<glm::vec3> bent_normals;  // unit vectors, or none
  // What share of the texel triangles cover, in 255ths; 0 only where none does.
  std::vector<std::uint8_t> coverage;

  std::size_t texel(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  std::size_t size() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

}  // namespace lkao::bake
