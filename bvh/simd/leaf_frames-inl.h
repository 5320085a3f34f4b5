// Triangles of a leaf against rays. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_LEAF_FRAMES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_LEAF_FRAMES_INL_H_
#undef LKAO_BVH_SIMD_LEAF_FRAMES_INL_H_
#else
#define LKAO_BVH_SIMD_LEAF_FRAMES_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <limits>

#include <hwy/highway.h>

#include "bvh/layout.h"
#include "bvh/pattern_cones.h"
#include "bvh/simd/lanes-inl.h"
#include "bvh/simd/ray_parts-inl.h"
#include "bvh/simd/ray_sets-inl.h"
#include "bvh/traversal.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

using Floats = hn::Vec<TriangleTag>;

// Bits of rays or triangles: blocked for sure, and perhaps, which only TriangleTest can decide.
struct Verdict {
  std::uint32_t sure;
  std::uint32_t perhaps;
};

// What triangle tests need to know of a receiver, as vectors.
struct LeafReceiver {
  LeafReceiver(const Layout& the_layout, const Query& the_query) : layout(the_layout), query(the_query) {
    const TriangleTag tag;
    origin_x = hn::Set(tag, query.rays.origin.x);
    origin_y = hn::Set(tag, query.rays.origin.y);
    origin_z = hn::Set(tag, query.rays.origin.z);
    const glm::vec3 size = layout.bounds.upper - layout.bounds.lower;
    near = hn::Set(tag, 0x1p-22f * std::max(size.x, std::max(size.y, size.z)));
    radius_rounding = hn::Set(tag, 0x1p-24f * query.radius);
  }

  const Layout& layout;
  const Query& query;
  Floats origin_x, origin_y, origin_z;
  Floats near;             // see LeafFrames
  Floats radius_rounding;  // of single precision
};

// The triangles of a leaf as one receiver sees them, in single precision.
//
// In the frame of a triangle (make_leaf) the origin is at (u, v, distance) and a ray goes by (du, dv, towards), where
// distance >= 0 and `towards` is measured towards the plane. The ray meets the triangle where, multiplied by `towards`,
//   u towards + distance du >= 0,  v towards + distance dv >= 0,  their sum <= towards,  and towards >= distance.
//
// Error bounds, with e = 2^-24, |p| the L1 norm of origin - vertex, r the length of the longest ray (L1: 1.7321 r) and
// g the steepness: gradients, difference and the sums of three products make the origin's coordinates uncertain by 5 e
// g |p| and 5 e |p|, the ray's by 4 e g 1.7321 r and 4 e 1.7321 r (5 e with the share of a part), so the two products
// and their sum by 22 e g |p| 1.7321 r = 39 e g |p| r. The third edge adds up the errors of both, and 6 e 1.7321 r. The
// bounds below grant more than that. To |p| comes a little for the definition's own tolerance where the origin is at
// the vertex.
class LeafFrames {
 public:
  HWY_INLINE LeafFrames(const LeafReceiver& receiver, const Leaf& leaf) : leaf_(leaf) {
    const TriangleTag tag;
    const auto px = hn::Sub(receiver.origin_x, load(leaf.vertex[0])),
               py = hn::Sub(receiver.origin_y, load(leaf.vertex[1])),
               pz = hn::Sub(receiver.origin_z, load(leaf.vertex[2]));
    u_ = dot(leaf.u_gradient, px, py, pz);
    v_ = dot(leaf.v_gradient, px, py, pz);
    const auto behind = dot(leaf.back_normal, px, py, pz);
    distance_ = hn::Abs(behind);
    // Rays go against back_normal where the origin is behind the triangle.
    turn_ = hn::AndNot(behind, hn::SignBit(tag));

    const auto reach = hn::Add(hn::Add(hn::Abs(px), hn::Abs(py)), hn::Add(hn::Abs(pz), receiver.near));
    const auto distance_slack = hn::Mul(hn::Set(tag, 6 * 0x1p-24f), reach);
    edge_slack_ = hn::Mul(hn::MulAdd(hn::Mul(load(leaf.steepness), reach), hn::Set(tag, 90.0f), hn::Set(tag, 12.0f)),
                          receiver.radius_rounding);
    own_slack_ = hn::MulAdd(hn::Set(tag, 10.0f), receiver.radius_rounding, distance_slack);

    // `!(x > y)` holds for NaN too.
    const std::uint32_t unsure_side = kAllTriangles & ~bits_of(tag, hn::Gt(distance_, distance_slack));
    if (HWY_UNLIKELY(unsure_side != 0)) decide_sides(receiver, unsure_side);
    const Query& query = receiver.query;
    if (HWY_UNLIKELY(query.sidedness == Sidedness::one_sided)) {
      candidates_ &= ~bits_of(tag, hn::Gt(behind, distance_slack));
    }
    if (HWY_UNLIKELY(query.excluded_primitive != kNoPrimitive)) {
      for (int i = 0; i < kLeafWidth; ++i) {
        if (leaf.primitives[i] == query.excluded_primitive) candidates_ &= ~(1u << i);
      }
    }
  }

  // Triangles that block one ray.
  template <class Parts>
  HWY_INLINE Verdict blocked(float x, float y, float z, const Parts& parts, std::uint32_t ray) const {
    const TriangleTag tag;
    const auto rx = hn::Set(tag, x), ry = hn::Set(tag, y), rz = hn::Set(tag, z);
    const auto towards = hn::Xor(dot(leaf_.back_normal, rx, ry, rz), turn_);
    const auto u = hn::MulAdd(u_, towards, hn::Mul(distance_, dot(leaf_.u_gradient, rx, ry, rz)));
    const auto v = hn::MulAdd(v_, towards, hn::Mul(distance_, dot(leaf_.v_gradient, rx, ry, rz)));
    const auto within =
        depth_within<Parts>(towards, distance_, parts.begin_of_one(tag, ray), parts.end_of_one(tag, ray));
    const auto least = hn::Min(hn::Min(u, v), hn::Sub(towards, hn::Add(u, v)));
    // NaN is neither less than 0 nor more. Minima may drop it, but not if it comes second, as `least` does.
    const auto missed = hn::Lt(hn::Min(hn::Add(within, own_slack_), hn::Add(least, edge_slack_)), hn::Zero(tag));
    const auto met = hn::Gt(hn::Min(hn::Sub(within, own_slack_), hn::Sub(least, edge_slack_)), hn::Zero(tag));
    return {bits_of(tag, met) & candidates_, ~bits_of(tag, missed) & candidates_};
  }

  // Triangles that some ray of the pattern may block: those whose plane is not farther away than rays go towards it
  // that are no longer than `far` and nowhere farther from `axis` than the cones say.
  HWY_INLINE std::uint32_t reached(float far, const glm::vec3& axis, const PatternCones& cones) const {
    const TriangleTag tag;
    const auto rounding = hn::Set(tag, 2e-6f);
    const auto x = hn::Set(tag, axis.x), y = hn::Set(tag, axis.y), z = hn::Set(tag, axis.z);
    const auto cosine = hn::Xor(dot(leaf_.back_normal, x, y, z), turn_);
    const auto sine = hn::Sqrt(hn::Max(hn::NegMulAdd(cosine, cosine, hn::Set(tag, 1.0f + 1e-6f)), hn::Zero(tag)));
    // The largest cosine that a ray of the pattern may have to the normal; 1 where the normal is among them.
    const auto widest_cosine = hn::Set(tag, cones.widest_cosine), widest_sine = hn::Set(tag, cones.widest_sine);
    const auto rim = hn::Add(hn::MulAdd(cosine, widest_cosine, hn::Mul(sine, widest_sine)), rounding);
    const auto largest = hn::IfThenElse(hn::Ge(hn::Add(cosine, rounding), widest_cosine), hn::Set(tag, 1.0f), rim);
    const auto nearest = hn::NegMulAdd(hn::Set(tag, 1.6f), own_slack_, distance_);
    const auto is_out = hn::Gt(nearest, hn::Mul(largest, hn::Set(tag, far * 1.0001f)));
    // Not those that are left to TriangleTest: their normals are unknown.
    const auto is_known = hn::Lt(edge_slack_, hn::Set(tag, std::numeric_limits<float>::infinity()));
    return candidates_ & ~bits_of(tag, hn::And(is_out, is_known));
  }

  // How far the ray goes beyond the triangle's plane, or its part begins before it, whichever is less.
  template <class Parts, class V>
  HWY_INLINE static V depth_within(V towards, V distance, V begin, V end) {
    if constexpr (Parts::kHasParts) {
      return hn::Min(hn::MulSub(towards, end, distance), hn::NegMulAdd(towards, begin, distance));
    } else {
      return hn::Sub(towards, distance);
    }
  }

 private:
  friend class LeafPlanes;  // leaf_planes-inl.h
  static constexpr std::uint32_t kAllTriangles = (1u << kLeafWidth) - 1;

  static HWY_INLINE Floats load(const float* values) { return hn::Load(TriangleTag(), values); }
  static HWY_INLINE Floats dot(const float (&rows)[3][kLeafWidth], Floats x, Floats y, Floats z) {
    return hn::MulAdd(load(rows[0]), x, hn::MulAdd(load(rows[1]), y, hn::Mul(load(rows[2]), z)));
  }

  // Takes the side from TriangleTest where it is in doubt: nearly coplanar receivers.
  HWY_NOINLINE void decide_sides(const LeafReceiver& receiver, std::uint32_t triangles) {
    const TriangleTag tag;
    for (; triangles != 0; triangles &= triangles - 1) {
      const int i = std::countr_zero(triangles);
      const TriangleTest test = make_test(receiver.layout, leaf_.primitives[i], receiver.query);
      const auto lane = mask_of(tag, 1u << i);
      if (!test.can_block()) {
        candidates_ &= ~(1u << i);
      } else {
        const auto turn = test.in_front() ? hn::Zero(tag) : hn::SignBit(tag);
        turn_ = hn::IfThenElse(lane, turn, turn_);
      }
    }
  }

  const Leaf& leaf_;
  Floats u_, v_, distance_;
  Floats turn_;  // sign bit
  Floats edge_slack_, own_slack_;
  std::uint32_t candidates_ = kAllTriangles;
};

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
