// A point and a box's face are one vector of 4 lanes here, on every processor (lanes.h). Not by Highway, which compiles
// once for each instruction set and chooses at run time: one cut is some dozen instructions in the middle of the
// builder, too few to call through a pointer, and wider vectors would have nothing to hold.
#include "bvh/triangle_clip.h"

#include <utility>

#include <glm/vec3.hpp>

#include "bvh/bounds.h"

namespace lkao::bvh {
namespace {

// 0 on the axis.
constexpr Lanes kOthers[3] = {{0, kInfinity, kInfinity, 0}, {kInfinity, 0, kInfinity, 0}, {kInfinity, kInfinity, 0, 0}};

struct Corner {
  Corner() = default;
  Corner(const glm::vec3& p, int axis) : point{p.x, p.y, p.z, 0}, key((&p.x)[axis]) {}

  Lanes point;
  float key;  // its coordinate along the axis of the split
};

class Edge {
 public:
  Edge(const Corner& from, const Corner& to) : from_(from), along_(to.point - from.point), length_(to.key - from.key) {
    margin_ = 0x1p-21f * abs(along_) + 0x1p-64f;
  }

  // Where the plane crosses it, with room for rounding. With u = 2^-24, the share and along_ are within 4 u and u of
  // themselves, their product rounds by another u, and the sum by u of itself, as do the faces. The margin's constant
  // is for numbers so small that they round to zero.
  Box crossing(float position) const {
    const Lanes point = from_.point + (position - from_.key) / length_ * along_;
    const Lanes margin = 0x1p-22f * abs(point) + margin_;
    return {point - margin, point + margin};
  }

 private:
  Corner from_;
  Lanes along_, margin_;
  float length_;  // along the axis
};

// A triangle with its corners in order along an axis.
class SortedTriangle {
 public:
  SortedTriangle(const PackedMesh& mesh, std::uint32_t primitive, int axis) : axis_(axis) {
    low_ = Corner(mesh.corner(primitive, 0), axis);
    middle_ = Corner(mesh.corner(primitive, 1), axis);
    high_ = Corner(mesh.corner(primitive, 2), axis);
    if (middle_.key < low_.key) std::swap(low_, middle_);
    if (high_.key < middle_.key) std::swap(middle_, high_);
    if (middle_.key < low_.key) std::swap(low_, middle_);
  }

  bool is_left_of(float position) const { return high_.key <= position; }
  bool is_right_of(float position) const { return low_.key >= position; }

  // For planes that have it neither on the left nor on the right.
  std::pair<Box, Box> cut(float position) const {
    const Box crossing = Edge(low_, high_).crossing(position);
    Box left = merge(crossing, low_.point), right = merge(crossing, high_.point);
    if (position < middle_.key) {
      const Box other = Edge(low_, middle_).crossing(position);
      left = merge(left, other);
      right = merge(merge(right, other), middle_.point);
    } else {
      const Box other = Edge(middle_, high_).crossing(position);
      left = merge(merge(left, other), middle_.point);
      right = merge(right, other);
    }
    left.upper = min(left.upper, position + kOthers[axis_]);
    right.lower = max(right.lower, position - kOthers[axis_]);
    return {left, right};
  }

 private:
  Corner low_, middle_, high_;
  int axis_;
};

}  // namespace

std::pair<Box, Box> cut_triangle(const PackedMesh& mesh, std::uint32_t primitive, const Box& within, int axis,
                                 float position) {
  const SortedTriangle triangle(mesh, primitive, axis);
  if (triangle.is_right_of(position)) return {empty_box(), within};
  if (triangle.is_left_of(position)) return {within, empty_box()};
  const auto [left, right] = triangle.cut(position);
  return {intersect(left, within), intersect(right, within)};
}

}  // namespace lkao::bvh
