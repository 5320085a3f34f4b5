// Half of the time of a build is spent here.
#include "bvh/triangle_clip.h"

#include <atomic>
#include <cstring>
#include <limits>
#include <utility>

#include <glm/vec3.hpp>

namespace lkao::bvh {
namespace {

// A vector of any processor: an extension of GCC and Clang. Of points and boxes the last lane has no meaning.
using Lanes = float __attribute__((vector_size(16)));

Lanes min(Lanes a, Lanes b) { return a < b ? a : b; }
Lanes max(Lanes a, Lanes b) { return a > b ? a : b; }
Lanes abs(Lanes a) { return max(a, -a); }

constexpr float kInfinity = std::numeric_limits<float>::infinity();
// 0 on the axis.
constexpr Lanes kOthers[3] = {{0, kInfinity, kInfinity, 0}, {kInfinity, 0, kInfinity, 0}, {kInfinity, kInfinity, 0, 0}};

struct Box {
  Lanes lower;
  Lanes upper;
};

constexpr Box kEmpty{{kInfinity, kInfinity, kInfinity, 0}, {-kInfinity, -kInfinity, -kInfinity, 0}};

Box merge(const Box& a, const Box& b) { return {min(a.lower, b.lower), max(a.upper, b.upper)}; }
Box merge(const Box& box, Lanes point) { return {min(box.lower, point), max(box.upper, point)}; }
Box intersect(const Box& a, const Box& b) { return {max(a.lower, b.lower), min(a.upper, b.upper)}; }

void store(const Box& box, RTCBounds& target) {
  static_assert(sizeof(box) == sizeof(target));
  std::memcpy(&target, &box, sizeof(target));
}

struct Corner {
  Corner() = default;
  Corner(const glm::vec3& p, unsigned axis) : point{p.x, p.y, p.z, 0}, key((&p.x)[axis]) {}

  Lanes point;
  float key;  // its coordinate along the axis of the split
};

class Edge {
 public:
  Edge() = default;
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
  SortedTriangle() = default;
  SortedTriangle(const TriangleMesh& mesh, std::uint32_t primitive, unsigned axis) : axis_(axis) {
    const glm::uvec3& t = mesh.triangles[primitive];
    low_ = Corner(mesh.positions[t.x], axis);
    middle_ = Corner(mesh.positions[t.y], axis);
    high_ = Corner(mesh.positions[t.z], axis);
    if (middle_.key < low_.key) std::swap(low_, middle_);
    if (high_.key < middle_.key) std::swap(middle_, high_);
    if (middle_.key < low_.key) std::swap(low_, middle_);
    low_to_high_ = Edge(low_, high_), low_to_middle_ = Edge(low_, middle_), middle_to_high_ = Edge(middle_, high_);
  }

  bool is_left_of(float position) const { return high_.key <= position; }
  bool is_right_of(float position) const { return low_.key >= position; }

  // For planes that have it neither on the left nor on the right.
  std::pair<Box, Box> cut(float position) const {
    const Box crossing = low_to_high_.crossing(position);
    Box left = merge(crossing, low_.point), right = merge(crossing, high_.point);
    if (position < middle_.key) {
      const Box other = low_to_middle_.crossing(position);
      left = merge(left, other);
      right = merge(merge(right, other), middle_.point);
    } else {
      const Box other = middle_to_high_.crossing(position);
      left = merge(merge(left, other), middle_.point);
      right = merge(right, other);
    }
    left.upper = min(left.upper, position + kOthers[axis_]);
    right.lower = max(right.lower, position - kOthers[axis_]);
    return {left, right};
  }

 private:
  Corner low_, middle_, high_;
  Edge low_to_high_, low_to_middle_, middle_to_high_;
  unsigned axis_;
};

// The builder cuts a triangle by plane after plane across an axis, so each thread keeps its last one.
const SortedTriangle& sorted_triangle(const ClipMesh& mesh, std::uint32_t primitive, unsigned axis) {
  struct Last {
    std::uint64_t mesh_number;
    std::uint32_t primitive;
    unsigned axis;
    SortedTriangle triangle;
  };
  static thread_local Last last{};
  if (last.mesh_number != mesh.number || last.primitive != primitive || last.axis != axis) {
    last = {mesh.number, primitive, axis, SortedTriangle(mesh.mesh, primitive, axis)};
  }
  return last.triangle;
}

std::uint64_t next_number() {
  static std::atomic<std::uint64_t> last_number = 0;
  return ++last_number;
}

}  // namespace

ClipMesh::ClipMesh(const TriangleMesh& triangle_mesh) : mesh(triangle_mesh), number(next_number()) {}

void split_triangle(const RTCBuildPrimitive* piece, unsigned axis, float position, RTCBounds* left, RTCBounds* right,
                    void* clip_mesh) {
  const SortedTriangle& triangle = sorted_triangle(*static_cast<const ClipMesh*>(clip_mesh), piece->primID, axis);
  const Box within{{piece->lower_x, piece->lower_y, piece->lower_z, 0},
                   {piece->upper_x, piece->upper_y, piece->upper_z, 0}};
  if (triangle.is_right_of(position)) {
    store(kEmpty, *left);
    store(within, *right);
  } else if (triangle.is_left_of(position)) {
    store(within, *left);
    store(kEmpty, *right);
  } else {
    const auto [left_box, right_box] = triangle.cut(position);
    store(intersect(left_box, within), *left);
    store(intersect(right_box, within), *right);
  }
}

}  // namespace lkao::bvh
