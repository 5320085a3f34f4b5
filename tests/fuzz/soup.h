// Meshes out of bytes, with all that goes wrong in real ones.
#pragma once

#include <glm/vec3.hpp>

#include "fuzz/byte_source.h"
#include "support/meshes.h"

namespace lkao::tests {

// Where a soup made in [-1, 1]^3 stands in the world.
struct Placement {
  float scale = 1;
  glm::vec3 offset{0};  // in sizes of the soup

  glm::vec3 place(const glm::vec3& p) const { return (p + offset) * scale; }
};

// Squares of larger numbers overflow in single precision.
inline constexpr float kLargest = 1e18f;

struct Soup {
  Mesh mesh;
  Placement placement;
  bool on_grid = false;  // all corners on a coarse grid: shared planes, flat boxes
};

// Up to some 300 triangles. In it: slivers, zero-area triangles, fans, duplicates, shared corners, coplanar and
// axis-aligned neighbours, coordinates that are NaN or infinite; in a wild one also huge ones.
Soup make_soup(ByteSource& bytes, bool is_wild);

// A point of the soup's own space; on its grid where it has one.
glm::vec3 soup_point(ByteSource& bytes, bool on_grid);

// Any floats, most of them no sensible ones, but for finite ones beyond kLargest.
glm::vec3 raw_point(ByteSource& bytes);

}  // namespace lkao::tests
