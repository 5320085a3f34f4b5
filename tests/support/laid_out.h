// Meshes in arrays as hosts have them.
#pragma once

#include <cstddef>
#include <cstring>
#include <vector>

#include "support/meshes.h"

namespace lkao::tests {

// The mesh as a renderer might have it: points and triangles with something else between them, at any address.
template <typename Index>
class LaidOut {
 public:
  LaidOut(const Mesh& mesh, std::size_t offset, std::size_t gap)
      : position_stride_(sizeof(glm::vec3) + gap),
        triangle_stride_(3 * sizeof(Index) + gap),
        positions_(offset + mesh.positions.size() * position_stride_, kGarbage),
        triangles_(offset + mesh.triangles.size() * triangle_stride_, kGarbage),
        mesh_{{reinterpret_cast<const float*>(&positions_[offset]), mesh.positions.size(), position_stride_},
              {reinterpret_cast<const Index*>(&triangles_[offset]), mesh.triangles.size(), triangle_stride_}} {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      std::memcpy(&positions_[offset + i * position_stride_], &mesh.positions[i], sizeof(glm::vec3));
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const glm::vec<3, Index> triangle(mesh.triangles[i]);
      std::memcpy(&triangles_[offset + i * triangle_stride_], &triangle, sizeof(triangle));
    }
  }

  const TriangleMesh& view() const { return mesh_; }

 private:
  static constexpr std::byte kGarbage{0xff};
  std::size_t position_stride_, triangle_stride_;
  std::vector<std::byte> positions_, triangles_;
  TriangleMesh mesh_;
};

}  // namespace lkao::tests
