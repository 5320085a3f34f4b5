// Triangles of a leaf against rays. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_LEAF_PLANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_LEAF_PLANES_INL_H_
#undef LKAO_BVH_SIMD_LEAF_PLANES_INL_H_
#else
#define LKAO_BVH_SIMD_LEAF_PLANES_INL_H_
#endif

#include <hwy/highway.h>

#include "bvh/layout.h"
#include "bvh/simd/ray_lanes-inl.h"
#include "bvh/traversal.h"
#include "bvh/triangle_test.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

using TriangleTag = hn::CappedTag<float, kWidth>;
using Floats = hn::Vec<TriangleTag>;

struct Vector {
  Floats x, y, z;
};

HWY_INLINE Vector operator-(const Vector& a, const Vector& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Vector operator+(const Vector& a, const Vector& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Vector cross(const Vector& a, const Vector& b) {
  return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}
HWY_INLINE Floats dot(const Vector& a, const Vector& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE Floats norm(const Vector& v) { return hn::Add(hn::Add(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z)); }

// Rays that are blocked for sure, and those that only TriangleTest can decide.
struct LaneBounds {
  std::uint32_t sure;
  std::uint32_t in_doubt;
};

// The planes of TriangleTest in single precision, for the triangles of a leaf at once. `value` = normal . ray + offset
// is not negative for any ray beyond the exact plane; from 2 x slack on the ray is beyond it for sure.
//
// Error bounds, with u = 2^-24 and L1 norms |.|: a corner relative to the origin is off by u |a|, an edge e by u |e|,
// the sum s of two corners by 2 u (|a| + |b|); their cross product, with its own rounding, by 14 u |e| (|a| + |b|) at
// most; its product with a ray no longer than r by 20 u r |e| (|a| + |b|). The bounds below grant more than that.
class LeafPlanes {
 public:
  HWY_INLINE LeafPlanes(const Leaf& leaf, const Query& query) {
    for (int i = 0; i < kWidth; i += static_cast<int>(hn::Lanes(TriangleTag()))) set(leaf, query, i);
  }

  // Triangles that may block a ray.
  std::uint32_t survivors() const { return survivors_; }

  HWY_INLINE LaneBounds blocked(int triangle, const RayLanes& rays, std::uint32_t mask) const {
    const RayTag tag;
    std::uint32_t maybe = 0, sure = 0;
    for (int i = 0; i < kLaneCount; i += static_cast<int>(hn::Lanes(tag))) {
      const auto x = hn::LoadU(tag, rays.x + i), y = hn::LoadU(tag, rays.y + i), z = hn::LoadU(tag, rays.z + i);
      const auto ab = value(0, triangle, x, y, z), bc = value(1, triangle, x, y, z), ca = value(2, triangle, x, y, z),
                 own = value(3, triangle, x, y, z);
      const auto least_edge = hn::Min(hn::Min(ab, bc), ca);
      const std::uint32_t lanes = bits_of(tag, hn::Ge(hn::Min(least_edge, own), hn::Zero(tag))) << i;
      if ((lanes & mask) == 0) continue;
      maybe |= lanes;
      const auto sure_lanes = hn::And(hn::Ge(least_edge, hn::Set(tag, edge_sure_[triangle])),
                                      hn::Ge(own, hn::Set(tag, own_sure_[triangle])));
      sure |= bits_of(tag, sure_lanes) << i;
    }
    return {maybe & sure & mask, maybe & ~sure & mask};
  }

 private:
  template <class V>
  HWY_INLINE V value(int plane, int triangle, V x, V y, V z) const {
    const RayTag tag;
    const V offset = hn::Set(tag, offset_[plane == 3][triangle]);
    return hn::MulAdd(hn::Set(tag, normals_[plane][0][triangle]), x,
                      hn::MulAdd(hn::Set(tag, normals_[plane][1][triangle]), y,
                                 hn::MulAdd(hn::Set(tag, normals_[plane][2][triangle]), z, offset)));
  }

  HWY_INLINE static Vector load_corner(const Leaf& leaf, int corner, int first) {
    const TriangleTag tag;
    return {hn::Load(tag, leaf.corners[corner][0] + first), hn::Load(tag, leaf.corners[corner][1] + first),
            hn::Load(tag, leaf.corners[corner][2] + first)};
  }

  HWY_INLINE void set(const Leaf& leaf, const Query& query, int first) {
    const TriangleTag tag;
    const auto constant = [&](float v) { return hn::Set(tag, v); };
    const Vector origin{constant(query.rays.origin.x), constant(query.rays.origin.y), constant(query.rays.origin.z)};
    const Vector corner_a = load_corner(leaf, 0, first), corner_b = load_corner(leaf, 1, first),
                 corner_c = load_corner(leaf, 2, first);
    const Vector a = corner_a - origin, b = corner_b - origin, c = corner_c - origin;
    const Floats radius = constant(query.radius), rounding = constant(32 * 0x1p-24f);
    const Floats size = hn::Max(hn::Max(norm(a), norm(b)), norm(c));

    // Wholly below the horizon; the slack is also that of rays that seem to lie in it.
    const Vector up{constant(query.up.x), constant(query.up.y), constant(query.up.z)};
    const Floats highest = hn::Max(hn::Max(dot(a, up), dot(b, up)), dot(c, up));
    const auto below = hn::Lt(highest, hn::Neg(hn::Mul(rounding, hn::Add(size, radius))));

    // The triangle's own plane. Its side is in doubt where the distance is within its error.
    const Vector ab = corner_b - corner_a, bc = corner_c - corner_b, ca = corner_a - corner_c;
    const Vector normal = cross(ca, ab);  // = ab x (c - a)
    const Floats longest = hn::Max(hn::Max(norm(ab), norm(bc)), norm(ca));
    const Floats error = hn::Mul(rounding, hn::Mul(longest, longest));  // of the normal
    const Floats distance = dot(a, normal), distance_error = hn::Mul(error, size);
    const Floats magnitude = hn::Abs(distance);
    const auto far = hn::Gt(magnitude, hn::MulAdd(radius, norm(normal), distance_error));

    const auto empty = hn::Eq(longest, hn::Zero(tag));
    std::uint32_t survivors = bits_of(tag, hn::Not(hn::Or(hn::Or(below, far), empty)));
    if (query.sidedness == Sidedness::one_sided) {
      survivors &= ~bits_of(tag, hn::Gt(distance, distance_error));
    }
    survivors &= (1u << hn::Lanes(tag)) - 1;
    if (survivors == 0) return;

    // Planes face away from the origin.
    const Floats facing = hn::CopySignToAbs(constant(1.0f), distance);
    store(3, first, normal, facing);
    const Floats own_slack = hn::MulAdd(error, radius, distance_error);
    hn::Store(hn::Sub(own_slack, magnitude), tag, offset_[1] + first);
    hn::Store(hn::Add(own_slack, own_slack), tag, own_sure_ + first);

    // The edges. All three get the slack of the longest.
    store(0, first, cross(a + b, ab), facing);
    store(1, first, cross(b + c, bc), facing);
    store(2, first, cross(c + a, ca), facing);
    const Floats edge_slack = hn::Mul(hn::Mul(rounding, radius), hn::Mul(longest, hn::Add(size, size)));
    hn::Store(edge_slack, tag, offset_[0] + first);
    hn::Store(hn::Add(edge_slack, edge_slack), tag, edge_sure_ + first);

    // `!(x > y)` holds for NaN too: what overflows single precision is left to TriangleTest.
    const std::uint32_t unsure_side = ~bits_of(tag, hn::Gt(magnitude, distance_error)) & survivors;
    for (std::uint32_t lanes = unsure_side; lanes != 0; lanes &= lanes - 1) {
      if (!decide_side(leaf, query, first + std::countr_zero(lanes))) survivors &= ~(lanes & (~lanes + 1));
    }
    for (std::uint32_t lanes = survivors; lanes != 0; lanes &= lanes - 1) {
      const int triangle = first + std::countr_zero(lanes);
      if (leaf.primitives[triangle] == query.excluded_primitive || leaf.primitives[triangle] == kNoPrimitive) {
        survivors &= ~(lanes & (~lanes + 1));
      }
    }
    survivors_ |= survivors << first;
  }

  HWY_INLINE void store(int plane, int first, const Vector& normal, Floats facing) {
    const TriangleTag tag;
    hn::Store(hn::Mul(normal.x, facing), tag, normals_[plane][0] + first);
    hn::Store(hn::Mul(normal.y, facing), tag, normals_[plane][1] + first);
    hn::Store(hn::Mul(normal.z, facing), tag, normals_[plane][2] + first);
  }

  // Takes the planes from TriangleTest where the side of the triangle was in doubt: nearly coplanar receivers. False
  // where the triangle cannot block any ray.
  HWY_NOINLINE bool decide_side(const Leaf& leaf, const Query& query, int triangle) {
    const TriangleTest test(leaf.corner(triangle, 0), leaf.corner(triangle, 1), leaf.corner(triangle, 2),
                            query.rays.origin, query.radius, query.sidedness);
    if (!test.can_block()) return false;
    for (int plane = 0; plane < 4; ++plane) {
      const glm::vec3 normal(plane == 3 ? test.normal() : test.edge(plane));
      for (int axis = 0; axis < 3; ++axis) normals_[plane][axis][triangle] = normal[axis];
    }
    offset_[1][triangle] = 0.5f * own_sure_[triangle] - static_cast<float>(test.distance());
    return true;
  }

  alignas(64) float normals_[4][3][kWidth];  // of the edges ab, bc, ca and of the triangle
  alignas(64) float offset_[2][kWidth];      // of the edges, of the triangle
  alignas(64) float edge_sure_[kWidth];
  alignas(64) float own_sure_[kWidth];
  std::uint32_t survivors_ = 0;
};

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
