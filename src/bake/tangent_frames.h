// What the directions of a tangent-space normal map are relative to.
//
// Based on: M. S. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", Master's thesis, University of Copenhagen,
// 2008, and what glTF 2.0 says of meshes without tangents.
// Differs from it: tangents are made orthogonal to the normal at each point, where many shaders leave them as
// interpolated, and triangles come as the file has them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>

#include "bake/texture_layout.h"

namespace lkao::bake {

class TangentFrames {
 public:
  // Tangents are means over the triangles around a corner that shade as one surface and lie side by side in the
  // texture, weighted by angle. The layout must outlive it.
  explicit TangentFrames(const TextureLayout& layout);

  // The columns are the tangent, along u; the bitangent, along v upwards; and the shading normal. Orthonormal. For
  // triangles that are baked.
  glm::mat3 at(std::uint32_t triangle, const glm::dvec3& weights) const;

 private:
  const TextureLayout& layout_;
  std::vector<std::array<glm::vec3, 3>> tangents_;  // of each triangle's corners
};

}  // namespace lkao::bake
