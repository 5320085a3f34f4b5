// The finished hierarchy in memory: 8-wide nodes over leaves of at most 8 triangles, both as structures of arrays, so
// that one vector instruction sees the same field of 8 children or 8 triangles.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "lkao/occluder_bvh.h"

namespace lkao::bvh {

inline constexpr int kWidth = 8;

// Names a child of a node: nothing, a node, or a leaf. Without a value until one is given.
class ChildRef {
 public:
  ChildRef() = default;
  static constexpr ChildRef none() { return ChildRef(kEmpty); }
  static constexpr ChildRef node(std::uint32_t index) { return ChildRef(index); }
  static constexpr ChildRef leaf(std::uint32_t index) { return ChildRef(index | kLeafBit); }

  constexpr bool is_empty() const { return bits_ == kEmpty; }
  constexpr bool is_leaf() const { return (bits_ & kLeafBit) != 0 && !is_empty(); }
  // Into Layout::nodes or Layout::leaves.
  constexpr std::uint32_t index() const { return bits_ & ~kLeafBit; }

 private:
  static constexpr std::uint32_t kLeafBit = 0x80000000u;
  static constexpr std::uint32_t kEmpty = 0xffffffffu;
  explicit constexpr ChildRef(std::uint32_t bits) : bits_(bits) {}
  std::uint32_t bits_;
};

// Children fill the node from the front. The box of an empty child is inverted (lower > upper). Every face is a step of
// float outside what the box holds: a ray that runs within the plane of what it holds is then strictly between the
// faces, and the slab test never multiplies 0 by the reciprocal of 0.
struct alignas(64) Node {
  float lower[3][kWidth];  // by axis, then child
  float upper[3][kWidth];
  ChildRef children[kWidth];

  Bounds child_bounds(int child) const {
    return {{lower[0][child], lower[1][child], lower[2][child]}, {upper[0][child], upper[1][child], upper[2][child]}};
  }
};

// Triangles fill the leaf from the front; the rest have kNoPrimitive and block nothing.
struct alignas(64) Leaf {
  float corners[3][3][kWidth];  // by corner, axis, then triangle
  std::uint32_t primitives[kWidth];

  glm::vec3 corner(int triangle, int which) const {
    return {corners[which][0][triangle], corners[which][1][triangle], corners[which][2][triangle]};
  }
};

struct Layout {
  std::vector<Node> nodes;  // the root is nodes[0]; none where there is no occluder
  std::vector<Leaf> leaves;
  Bounds bounds;
  BuildReport report;
};

}  // namespace lkao::bvh
