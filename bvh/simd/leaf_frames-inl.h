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
    const Verdict verdict = judge(tag, u, v, towards, within, edge_slack_, own_slack_);
    return {verdict.sure & candidates_, verdict.perhaps & candidates_};
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

  // Where rays are beyond all planes, for sure or perhaps, as bits. `within` as depth_within() gives it.
  template <class Tag, class V>
  HWY_INLINE static Verdict judge(Tag tag, V u, V v, V towards, V within, V edge_slack, V own_slack) {
    const auto least = hn::Min(hn::Min(u, v), hn::Sub(towards, hn::Add(u, v)));
    // NaN is neither less than 0 nor more. Minima may drop it, but not if it comes second, as `least` does.
    const auto missed = hn::Lt(hn::Min(hn::Add(within, own_slack), hn::Add(least, edge_slack)), hn::Zero(tag));
    const auto met = hn::Gt(hn::Min(hn::Sub(within, own_slack), hn::Sub(least, edge_slack)), hn::Zero(tag));
    return {bits_of(tag, met), ~bits_of(tag, missed)};
  }

 private:
  friend class LeafPlanes;
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

// The same for many rays: each triangle's planes through the origin, set up once.
class LeafPlanes {
 public:
  HWY_INLINE explicit LeafPlanes(const LeafFrames& frames) {
    const TriangleTag tag;
    for (int axis = 0; axis < 3; ++axis) {
      const auto towards = hn::Xor(frames.load(frames.leaf_.back_normal[axis]), frames.turn_);
      hn::Store(towards, tag, towards_[axis]);
      hn::Store(hn::MulAdd(frames.u_, towards, hn::Mul(frames.distance_, frames.load(frames.leaf_.u_gradient[axis]))),
                tag, u_[axis]);
      hn::Store(hn::MulAdd(frames.v_, towards, hn::Mul(frames.distance_, frames.load(frames.leaf_.v_gradient[axis]))),
                tag, v_[axis]);
    }
    hn::Store(frames.distance_, tag, distance_);
    hn::Store(frames.edge_slack_, tag, edge_slack_);
    hn::Store(frames.own_slack_, tag, own_slack_);
    // What cannot block a ray is too far away.
    for (std::uint32_t rest = LeafFrames::kAllTriangles & ~frames.candidates_; rest != 0; rest &= rest - 1) {
      distance_[std::countr_zero(rest)] = std::numeric_limits<float>::infinity();
    }
  }

  // Of the rays of a chunk, those that some triangle blocks.
  template <class Parts>
  HWY_INLINE Verdict blocked(const RaySet& rays, const Parts& parts, int chunk) const {
    const RayTag tag;
    Verdict all{0, 0};
    for (int i = 0; i < kLaneCount; i += lane_count(tag)) {
      const int first = chunk * kLaneCount + i;
      const auto x = hn::Load(tag, rays.x + first), y = hn::Load(tag, rays.y + first),
                 z = hn::Load(tag, rays.z + first);
      const auto begin = parts.begin(tag, first), end = parts.end(tag, first);
      Verdict some{0, 0};
      for (int triangle = 0; triangle < kLeafWidth; ++triangle) {
        const auto towards = dot(towards_, triangle, x, y, z);
        const auto within = LeafFrames::depth_within<Parts>(towards, hn::Set(tag, distance_[triangle]), begin, end);
        const Verdict one =
            LeafFrames::judge(tag, dot(u_, triangle, x, y, z), dot(v_, triangle, x, y, z), towards, within,
                              hn::Set(tag, edge_slack_[triangle]), hn::Set(tag, own_slack_[triangle]));
        some.sure |= one.sure;
        some.perhaps |= one.perhaps;
      }
      all.sure |= (some.sure & kLanes) << i;
      all.perhaps |= (some.perhaps & kLanes) << i;
    }
    return all;
  }

 private:
  static constexpr std::uint32_t kLanes = (1u << hn::MaxLanes(RayTag())) - 1;

  template <class V>
  static HWY_INLINE V dot(const float (&plane)[3][kLeafWidth], int triangle, V x, V y, V z) {
    const RayTag tag;
    return hn::MulAdd(hn::Set(tag, plane[0][triangle]), x,
                      hn::MulAdd(hn::Set(tag, plane[1][triangle]), y, hn::Mul(hn::Set(tag, plane[2][triangle]), z)));
  }

  alignas(64) float u_[3][kLeafWidth];
  alignas(64) float v_[3][kLeafWidth];
  alignas(64) float towards_[3][kLeafWidth];
  alignas(64) float distance_[kLeafWidth];
  alignas(64) float edge_slack_[kLeafWidth];
  alignas(64) float own_slack_[kLeafWidth];
};

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
