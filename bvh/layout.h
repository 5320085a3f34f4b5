// The finished hierarchy in memory: 8-wide nodes over leaves of at most 4 triangles, both as structures of arrays, so
// that one vector instruction sees the same field of 8 children or 4 triangles.
#pragma once

#include <compare>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "bvh/hole_grids.h"
#include "bvh/huge_pages.h"
#include "bvh/packed_mesh.h"
#include "bvh/usable_triangle.h"
#include "lkao/occluder_bvh.h"

namespace lkao::bvh {

inline constexpr int kWidth = 8;
inline constexpr int kLeafWidth = 4;
// No leaf is farther from the root.
inline constexpr int kMaxDepth = 64;

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

  // For vectors of them: index() with kLeafBit where it is a leaf.
  static constexpr std::uint32_t kLeafBit = 0x80000000u;
  constexpr std::uint32_t bits() const { return bits_; }

 private:
  static constexpr std::uint32_t kEmpty = 0xffffffffu;
  explicit constexpr ChildRef(std::uint32_t bits) : bits_(bits) {}
  std::uint32_t bits_;
};

// Children fill the node from the front. The box of an empty child is a point at infinity, which no ray meets. Every
// other face is a step of float, and at least kMargin, outside what the box holds: a ray that runs within the plane of
// what it holds is then strictly between the faces, and its reciprocal may be limited to 1 / kMargin.
struct alignas(64) Node {
  float faces[2][3][kWidth];  // lower and upper, by axis, then child
  ChildRef children[kWidth];

  static constexpr float kMargin = 0x1p-59f;

  const std::uint32_t* child_bits() const { return reinterpret_cast<const std::uint32_t*>(children); }
  static Node empty() {
    Node node;
    for (int child = 0; child < kWidth; ++child) node.clear_child(child);
    return node;
  }

  Bounds child_bounds(int child) const {
    return {{faces[0][0][child], faces[0][1][child], faces[0][2][child]},
            {faces[1][0][child], faces[1][1][child], faces[1][2][child]}};
  }
  void set_child(int child, const Bounds& box, ChildRef ref) {
    for (int axis = 0; axis < 3; ++axis) {
      faces[0][axis][child] = box.lower[axis];
      faces[1][axis][child] = box.upper[axis];
    }
    children[child] = ref;
  }
  void clear_child(int child) { set_unreachable(child, ChildRef::none()); }
  // A child that holds nothing which blocks a ray: its box is as that of an empty one.
  void set_unreachable(int child, ChildRef ref) {
    const glm::vec3 infinity(std::numeric_limits<float>::infinity());
    set_child(child, {infinity, infinity}, ref);
  }
  bool is_unreachable(int child) const { return faces[0][0][child] == std::numeric_limits<float>::infinity(); }
};

// What decides about rays and up to 4 triangles in single precision, from a receiver anywhere: see make_leaf. Triangles
// fill the leaf from the front; the places that are left repeat the first.
struct alignas(32) Leaf {
  float vertex[3][kLeafWidth];       // one corner, the origin of the triangle's frame; by axis, then triangle
  float u_gradient[3][kLeafWidth];   // of the first barycentric coordinate, which is 0 at `vertex`
  float v_gradient[3][kLeafWidth];   // of the second
  float back_normal[3][kLeafWidth];  // unit vector to the side that the triangle does not face
  float steepness[kLeafWidth];       // largest component of the gradients, below 0 where the triangle has holes;
                                     // infinite: leave it to TriangleTest
  std::uint32_t primitives[kLeafWidth];

  int triangle_count() const {
    int count = 1;
    while (count < kLeafWidth && primitives[count] != primitives[0]) ++count;
    return count;
  }
};

// Where queries begin; without a child where there is no occluder.
inline const Node& root_of(std::span<const Node> nodes) {
  static const Node kEmpty = Node::empty();
  return nodes.empty() ? kEmpty : nodes[0];
}

// A triangle of a leaf that blocks nothing where a refit has put its corners. The leaf has left it out, and its box;
// the next refit looks at it again.
struct RestingTriangle {
  std::uint32_t leaf;
  std::uint32_t primitive;

  friend auto operator<=>(const RestingTriangle&, const RestingTriangle&) = default;  // NOLINT(modernize-use-nullptr)
};

// Half the surface of boxes, summed up by what they hold.
struct SurfaceAreas {
  double root = 0;       // all
  double nodes = 0;      // a node below the root
  double leaves = 0;     // a leaf
  double triangles = 0;  // a triangle of a leaf, by itself and whole
};

struct Layout {
  std::vector<Node, HugePageAllocator<Node>> nodes;  // the root first
  std::vector<Leaf, HugePageAllocator<Leaf>> leaves;
  PackedMesh mesh;  // for TriangleTest
  Bounds bounds;
  BuildReport report;

  std::shared_ptr<const HoleGrids> grids;  // of options.cut_outs; null where nothing is known of them

  // For refits, and what decides about triangles with holes.
  BuildOptions options;
  SurfaceAreas built;                    // at the build
  std::vector<std::uint32_t> dropped;    // primitives in no leaf, in order
  std::vector<RestingTriangle> resting;  // in order

  const Node& root() const { return root_of(nodes); }
  std::span<const Node> roots() const { return {&root(), 1}; }
};

}  // namespace lkao::bvh
