#include "scene/formats/polygons.h"

#include <cstdint>

namespace lkao::scene {

std::span<const glm::uvec3> PolygonCutter::cut(std::span<const glm::dvec3> corners) {
  triangles_.clear();
  for (std::size_t i = 2; i < corners.size(); ++i) {
    triangles_.emplace_back(0u, static_cast<std::uint32_t>(i - 1), static_cast<std::uint32_t>(i));
  }
  return triangles_;
}

}  // namespace lkao::scene
