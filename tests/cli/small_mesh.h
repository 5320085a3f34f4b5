// Small mesh files for tests.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace lkao::test {

// The bytes of a binary little-endian PLY.
inline std::string ply_bytes(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(positions.size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                      std::to_string(triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  const auto append = [&bytes](const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  };
  for (const glm::vec3& position : positions) append(&position, sizeof position);
  for (const glm::uvec3& triangle : triangles) {
    bytes.push_back(3);
    append(&triangle, sizeof triangle);
  }
  return bytes;
}

// A horizontal square of two triangles, facing up, and a third triangle hanging over it.
inline std::string roofed_square_ply() {
  return ply_bytes({{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}, {-1, 0.5f, -1}, {-1, 0.5f, 1}, {1, 0.5f, 1}},
                   {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}});
}

}  // namespace lkao::test
