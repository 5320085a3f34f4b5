// Triangles of a leaf against rays. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_LEAF_FRAMES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_LEAF_FRAMES_INL_H_
#undef LKAO_BVH_SIMD_LEAF_FRAMES_INL_H_
#else
#define LKAO_BVH_SIMD_LEAF_FRAMES_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>

#include <hwy/highway.h>

#include "bvh/defined_triangle.h"
#include "bvh/layout.h"
#include "bvh/pattern_cones.h"
#include "bvh/query.h"
#include "bvh/simd/hole_squares-inl.h"
#include "bvh/simd/lanes-inl.h"
#include "bvh/simd/ray_parts-inl.h"
#include "bvh/simd/ray_sets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

// Bits of rays or triangles: blocked for sure, and perhaps, which only TriangleTest can decide.
struct Verdict {
  std::uint32_t sure;
  std::uint32_t perhaps;
};

// What triangle tests need to know of a receiver.
struct LeafReceiver {
  LeafReceiver(const Layout& the_layout, const Query& the_query) : layout(the_layout), query(the_query) {
    origin = query.rays.origin;
    const glm::vec3 size = layout.bounds.upper - layout.bounds.lower;
    near = 0x1p-22f * std::max(size.x, std::max(size.y, size.z));
    radius_rounding = 0x1p-24f * query.radius;
    displacement = query.placed != nullptr ? query.placed->displacement : 0;
    has_holes = bvh::has_holes(layout.options.cut_outs);
  }

  const Layout& layout;
  const Query& query;
  glm::vec3 origin;
  float near;             // see LeafFrames
  float radius_rounding;  // of single precision
  float displacement;     // of corners; 0 where the rays are in the world
  bool has_holes;         // of some triangle
};

// Of a coordinate from 0 to 1, beside what the slacks of triangles say: quotients and their rounding to float.
inline constexpr float kPlaceRounding = 0x1p-20f;

// Leaves that are answered at once, and numbers of one ray for each. Vectors of 16 lanes would hold 4, but filling them
// costs more than it saves.
inline constexpr int kLeavesAtOnce = static_cast<int>(hn::MaxLanes(RayTag())) >= 2 * kLeafWidth ? 2 : 1;
template <int kCount>
using LeafTag = hn::CappedTag<float, static_cast<std::size_t>(kCount) * kLeafWidth>;

// A row of each leaf, side by side.
template <int kCount>
HWY_INLINE hn::Vec<LeafTag<kCount>> load_rows(const float* const (&rows)[kCount]) {
  const LeafTag<1> one;
  if constexpr (kCount == 1) {
    return hn::Load(one, rows[0]);
  } else {
    return hn::Combine(LeafTag<2>(), hn::Load(one, rows[1]), hn::Load(one, rows[0]));
  }
}

// values[rays[i]] for all triangles of leaf i.
template <int kCount>
HWY_INLINE hn::Vec<LeafTag<kCount>> spread(const float* values, const std::uint32_t (&rays)[kCount]) {
  const LeafTag<1> one;
  if constexpr (kCount == 1) {
    return hn::Set(one, values[rays[0]]);
  } else {
    return hn::Combine(LeafTag<2>(), hn::Set(one, values[rays[1]]), hn::Set(one, values[rays[0]]));
  }
}

// The triangles of one leaf or several as one receiver sees them, in single precision.
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
//
// kHasHoles: some triangles may have holes.
template <int kCount, bool kHasHoles = false>
class LeafFrames {
 public:
  using Tag = LeafTag<kCount>;
  using Floats = hn::Vec<Tag>;
  static constexpr std::uint32_t kAllTriangles = (1u << (kCount * kLeafWidth)) - 1;

  HWY_INLINE LeafFrames(const LeafReceiver& receiver, const Leaf* const (&leaves)[kCount])
      : LeafFrames(receiver, leaves, [&](int axis) HWY_ATTR { return hn::Set(Tag(), receiver.origin[axis]); }) {}

  // The same with an origin for each leaf.
  HWY_INLINE LeafFrames(const LeafReceiver& receiver, const Leaf* const (&leaves)[kCount],
                        const float* const (&origins)[kCount])
      : LeafFrames(receiver, leaves, [&](int axis) HWY_ATTR { return spread_components(origins, axis); }) {}

  template <class OriginOf>
  HWY_INLINE LeafFrames(const LeafReceiver& receiver, const Leaf* const (&leaves)[kCount], const OriginOf& origin)
      : leaves_(leaves) {
    const Tag tag;
    const auto px = hn::Sub(origin(0), load([](const Leaf&leaf) { return leaf.vertex[0]; })),
               py = hn::Sub(origin(1), load([](const Leaf&leaf) { return leaf.vertex[1]; })),
               pz = hn::Sub(origin(2), load([](const Leaf&leaf) { return leaf.vertex[2]; }));
    u_ = dot(kUGradient, px, py, pz);
    v_ = dot(kVGradient, px, py, pz);
    const auto behind = dot(kBackNormal, px, py, pz);
    distance_ = hn::Abs(behind);
    // Rays go against back_normal where the origin is behind the triangle.
    turn_ = hn::AndNot(behind, hn::SignBit(tag));

    const auto reach = hn::Add(hn::Add(hn::Abs(px), hn::Abs(py)), hn::Add(hn::Abs(pz), hn::Set(tag, receiver.near)));
    auto distance_slack = hn::Mul(hn::Set(tag, 6 * 0x1p-24f), reach);
    const auto radius_rounding = hn::Set(tag, receiver.radius_rounding);
    auto steepness = load([](const Leaf& leaf) { return leaf.steepness; });
    if constexpr (kHasHoles) {
      holed_ = bits_of(tag, hn::Lt(steepness, hn::Zero(tag)));
      steepness = hn::Abs(steepness);
    }
    edge_slack_ =
        hn::Mul(hn::MulAdd(hn::Mul(steepness, reach), hn::Set(tag, 90.0f), hn::Set(tag, 12.0f)), radius_rounding);
    own_slack_ = hn::MulAdd(hn::Set(tag, 10.0f), radius_rounding, distance_slack);
    auto side_slack = distance_slack;  // beyond it the origin is on the side that it seems to be
    if (HWY_UNLIKELY(receiver.displacement > 0)) {
      side_slack = allow_for_displacement(receiver, steepness, reach, distance_slack);
      distance_slack = hn::MulAdd(hn::Set(tag, 1.1f), hn::Set(tag, receiver.displacement), distance_slack);
    }

    // `!(x > y)` holds for NaN too.
    unsure_sides_ = kAllTriangles & ~bits_of(tag, hn::Gt(distance_, distance_slack));
    const Query& query = receiver.query;
    if (HWY_UNLIKELY(query.sidedness == Sidedness::one_sided)) {
      candidates_ &= ~bits_of(tag, hn::Gt(behind, side_slack));
    }
    if (HWY_UNLIKELY(query.excluded_primitive != kNoPrimitive)) {
      for (int i = 0; i < kCount; ++i) {
        candidates_ &= ~(places_of(query.excluded_primitive, *leaves_[i]) << (i * kLeafWidth));
      }
    }
  }

  // Triangles that have the origin so close to their planes that its side is not sure. What blocked() says of them is
  // wrong until decide_sides() has asked TriangleTest.
  std::uint32_t unsure_sides() const { return unsure_sides_ & candidates_; }
  HWY_INLINE void decide_sides(const LeafReceiver& receiver) {
    static_assert(kCount == 1);
    if (HWY_LIKELY(unsure_sides() == 0)) return;
    const Tag tag;
    const Sides sides = sides_of(receiver, *leaves_[0], unsure_sides());
    const auto turn = hn::IfThenElse(mask_of(tag, sides.in_front), hn::Zero(tag), hn::SignBit(tag));
    turn_ = hn::IfThenElse(mask_of(tag, unsure_sides()), turn, turn_);
    candidates_ &= ~sides.cannot_block;
  }

  // Triangles that can block a ray at all.
  std::uint32_t candidates() const { return candidates_; }

  // Triangles with holes, of which blocked() says whether they are met.
  std::uint32_t holed() const { return holed_; }

  // Triangles that block the ray of their leaf.
  template <class Parts>
  HWY_INLINE Verdict blocked(const RaySet& rays, const Parts& parts, const std::uint32_t (&numbers)[kCount]) const {
    const auto rx = spread(rays.x, numbers), ry = spread(rays.y, numbers), rz = spread(rays.z, numbers);
    return blocked(rx, ry, rz, parts, numbers);
  }

  // The same for whole rays, given by their components.
  HWY_INLINE Verdict blocked(const float* const (&rays)[kCount]) const {
    return blocked(spread_components(rays, 0), spread_components(rays, 1), spread_components(rays, 2), WholeRays(), {});
  }

  template <class Parts>
  HWY_INLINE Verdict blocked(Floats rx, Floats ry, Floats rz, const Parts& parts,
                             const std::uint32_t (&numbers)[kCount]) const {
    const Tag tag;
    const auto towards = hn::Xor(dot(kBackNormal, rx, ry, rz), turn_);
    const auto u = hn::MulAdd(u_, towards, hn::Mul(distance_, dot(kUGradient, rx, ry, rz)));
    const auto v = hn::MulAdd(v_, towards, hn::Mul(distance_, dot(kVGradient, rx, ry, rz)));
    // How far the ray goes beyond the triangle's plane, or its part begins before it, whichever is less.
    auto within = hn::Sub(towards, distance_);
    if constexpr (Parts::kHasParts) {
      const auto begin = spread(parts.parts.begin, numbers), end = spread(parts.parts.end, numbers);
      within = hn::Min(hn::MulSub(towards, end, distance_), hn::NegMulAdd(towards, begin, distance_));
    }
    const auto least = hn::Min(hn::Min(u, v), hn::Sub(towards, hn::Add(u, v)));
    // NaN is neither less than 0 nor more. Minima may drop it, but not if it comes second, as `least` does.
    const auto missed = hn::Lt(hn::Min(hn::Add(within, own_slack_), hn::Add(least, edge_slack_)), hn::Zero(tag));
    const auto met = hn::Gt(hn::Min(hn::Sub(within, own_slack_), hn::Sub(least, edge_slack_)), hn::Zero(tag));
    return {bits_of(tag, met) & candidates_, ~bits_of(tag, missed) & candidates_};
  }

  // Where the ray meets the triangles that it is sure to meet, up to their holes.
  //
  // A coordinate is u / towards. The edge slack covers the errors of both, and where corners are off by d, three times
  // it is enough: the same point of the moved triangle lies no farther than d away, and what the ray meets no farther
  // than d r / towards from there, which changes the coordinate by no more than 1.7321 g (d + d r / towards); the slack
  // of what is sure holds 8.4 d g r, and r is no less than `towards`.
  HWY_INLINE Places<Tag> places(const RaySet& rays, const std::uint32_t (&numbers)[kCount]) const {
    const Tag tag;
    const auto rx = spread(rays.x, numbers), ry = spread(rays.y, numbers), rz = spread(rays.z, numbers);
    const auto towards = hn::Xor(dot(kBackNormal, rx, ry, rz), turn_);
    const auto u = hn::MulAdd(u_, towards, hn::Mul(distance_, dot(kUGradient, rx, ry, rz)));
    const auto v = hn::MulAdd(v_, towards, hn::Mul(distance_, dot(kVGradient, rx, ry, rz)));
    const auto inverse = hn::Div(hn::Set(tag, 1.0f), towards);
    return {hn::Mul(u, inverse), hn::Mul(v, inverse),
            hn::MulAdd(hn::Mul(hn::Set(tag, 3.0f), edge_slack_), inverse, hn::Set(tag, kPlaceRounding))};
  }

  // What is known of the triangles with holes there, of those that it is sure to meet.
  HWY_INLINE KnownHoles known_holes(const HoleSquares& squares, const RaySet& rays,
                                    const std::uint32_t (&numbers)[kCount]) const {
    const Tag tag;
    const hn::RebindToSigned<Tag> number_tag;
    const float* rows[kCount];
    for (int i = 0; i < kCount; ++i) rows[i] = reinterpret_cast<const float*>(leaves_[i]->primitives);
    return squares.at(tag, hn::BitCast(number_tag, load_rows(rows)), places(rays, numbers));
  }

  // Triangles that may block some ray of the pattern or bundle: those whose plane is not farther away than rays go
  // towards it that are no longer than `far` and nowhere farther from `axis` than the cones say.
  HWY_INLINE std::uint32_t reached(float far, const glm::vec3& axis, const PatternCones& cones) const {
    const Tag tag;
    const auto nearest = hn::NegMulAdd(hn::Set(tag, 1.6f), own_slack_, distance_);
    const auto farthest = cones.is_bundle ? farthest_of_bundle(cones) : farthest_of_pattern(far, axis, cones);
    const auto is_out = hn::Gt(nearest, farthest);
    // Not those that are left to TriangleTest: their normals are unknown.
    auto steepness = load([](const Leaf& leaf) { return leaf.steepness; });
    if constexpr (kHasHoles) steepness = hn::Abs(steepness);
    const auto is_known = hn::Lt(steepness, hn::Set(tag, std::numeric_limits<float>::infinity()));
    return candidates_ & ~bits_of(tag, hn::And(is_out, is_known));
  }

 private:
  // How far rays go towards the triangles' planes, at most: by the intervals of their components ...
  HWY_INLINE Floats farthest_of_bundle(const PatternCones& cones) const {
    const Tag tag;
    auto middle = hn::Zero(tag), spread = middle;
    for (int a = 0; a < 3; ++a) {
      const auto normal = load(kBackNormal, a);
      const float center = 0.5f * cones.least[a] + 0.5f * cones.most[a];
      const float half = 0.5f * cones.most[a] - 0.5f * cones.least[a];
      middle = hn::MulAdd(normal, hn::Set(tag, center), middle);
      spread = hn::MulAdd(hn::Abs(normal), hn::Set(tag, half + 0x1p-20f * std::fabs(center)), spread);
    }
    return hn::MulAdd(spread, hn::Set(tag, 1.0f + 0x1p-20f), hn::Xor(middle, turn_));
  }

  // ... or by the cone around the pattern.
  HWY_INLINE Floats farthest_of_pattern(float far, const glm::vec3& axis, const PatternCones& cones) const {
    const Tag tag;
    const auto rounding = hn::Set(tag, 2e-6f);
    const auto cosine =
        hn::Xor(dot(kBackNormal, hn::Set(tag, axis.x), hn::Set(tag, axis.y), hn::Set(tag, axis.z)), turn_);
    const auto sine = hn::Sqrt(hn::Max(hn::NegMulAdd(cosine, cosine, hn::Set(tag, 1.0f + 1e-6f)), hn::Zero(tag)));
    // The largest cosine that a ray of the pattern may have to the normal; 1 where the normal is among them.
    const auto widest_cosine = hn::Set(tag, cones.widest_cosine), widest_sine = hn::Set(tag, cones.widest_sine);
    const auto rim = hn::Add(hn::MulAdd(cosine, widest_cosine, hn::Mul(sine, widest_sine)), rounding);
    const auto largest = hn::IfThenElse(hn::Ge(hn::Add(cosine, rounding), widest_cosine), hn::Set(tag, 1.0f), rim);
    return hn::Mul(largest, hn::Set(tag, far * 1.0001f));
  }

  friend class LeafPlanes;  // leaf_planes-inl.h
  using Rows = float (Leaf::*)[3][kLeafWidth];
  static constexpr Rows kUGradient = &Leaf::u_gradient, kVGradient = &Leaf::v_gradient,
                        kBackNormal = &Leaf::back_normal;

  static HWY_INLINE Floats spread_components(const float* const (&of)[kCount], int axis) {
    const LeafTag<1> one;
    if constexpr (kCount == 1) {
      return hn::Set(one, of[0][axis]);
    } else {
      return hn::Combine(LeafTag<2>(), hn::Set(one, of[1][axis]), hn::Set(one, of[0][axis]));
    }
  }

  template <class RowOf>
  HWY_INLINE Floats load(const RowOf& row_of) const {
    const float* rows[kCount];
    for (int i = 0; i < kCount; ++i) rows[i] = row_of(*leaves_[i]);
    return load_rows(rows);
  }
  HWY_INLINE Floats load(Rows rows, int axis) const {
    return load([&](const Leaf& leaf) { return (leaf.*rows)[axis]; });
  }
  HWY_INLINE Floats dot(Rows rows, Floats x, Floats y, Floats z) const {
    return hn::MulAdd(load(rows, 0), x, hn::MulAdd(load(rows, 1), y, hn::Mul(load(rows, 2), z)));
  }

  // Where corners may be as far as d from where they count, all in the space of the rays. Returns the distance from
  // the plane beyond which its side is sure; nearer ones are met for sure by no ray.
  //
  // A ray that meets the moved triangle does so no farther than d from the plane, so its own plane is uncertain by d,
  // on whatever side the moved plane has the origin: where the origin is farther than d, rays away from it miss.
  //
  // Let u and v be the coordinates of the origin, w = 1 + |u| + |v|, D its distance and g the steepness, with d g less
  // than 1/16. The moved plane has it at D' > 0.9 D - 2 d w. The normals of the edges' planes, in units of twice the
  // area, are no longer than N = w + 3.5 g D, and those of the moved ones no longer than N + (0.4 g |p| + 0.45). A ray
  // that meets the moved triangle is beyond each edge but for d times the normal, divided by the share of the ray up to
  // there, more than (D - d) / r: where D > 9 d w, by 1.2 d N r / D. The other way round, from the triangle to the
  // moved one, whose volume with the origin is more than half of the other's, it is 2 d (N + 0.4 g |p| + 0.45) r / D.
  HWY_INLINE Floats allow_for_displacement(const LeafReceiver& receiver, Floats steepness, Floats reach,
                                           Floats distance_slack) {
    const Tag tag;
    const auto by = hn::Set(tag, receiver.displacement), radius = hn::Set(tag, receiver.query.radius);
    const auto sides = hn::Add(hn::Set(tag, 1.0f), hn::Add(hn::Abs(u_), hn::Abs(v_)));
    const auto steep_reach = hn::Mul(steepness, reach);
    const auto is_firm = hn::Lt(hn::Mul(by, steepness), hn::Set(tag, 0x1p-4f));
    const auto side_slack = hn::IfThenElse(is_firm, hn::MulAdd(hn::Set(tag, 9.0f), hn::Mul(by, sides), distance_slack),
                                           hn::Set(tag, std::numeric_limits<float>::infinity()));
    const auto around =
        hn::MulAdd(hn::Set(tag, 2.4f), sides, hn::MulAdd(hn::Set(tag, 0.9f), steep_reach, hn::Set(tag, 1.0f)));
    const auto turned = hn::MulAdd(hn::Set(tag, 8.4f), steepness, hn::Div(around, distance_));
    // No ray is farther beyond an edge than this, or less.
    const auto most = hn::MulAdd(hn::Set(tag, 8.0f), steep_reach, hn::Set(tag, 2.0f));
    const auto is_sure = hn::Gt(distance_, side_slack);
    edge_slack_ = hn::MulAdd(hn::IfThenElse(is_sure, hn::Mul(by, turned), most), radius, edge_slack_);
    own_slack_ = hn::MulAdd(hn::Set(tag, 1.1f), by, own_slack_);
    return side_slack;
  }

  // What is called seldom takes no part of this as an argument: all of it stays in registers.
  static HWY_NOINLINE std::uint32_t places_of(std::uint32_t primitive, const Leaf& leaf) {
    std::uint32_t places = 0;
    for (int i = 0; i < kLeafWidth; ++i) places |= static_cast<std::uint32_t>(leaf.primitives[i] == primitive) << i;
    return places;
  }

  struct Sides {
    std::uint32_t in_front, cannot_block;
  };
  static HWY_NOINLINE Sides sides_of(const LeafReceiver& receiver, const Leaf& leaf, std::uint32_t triangles) {
    Sides sides{0, 0};
    for (; triangles != 0; triangles &= triangles - 1) {
      const int i = std::countr_zero(triangles);
      DefinedTriangle triangle(receiver.layout, receiver.query, leaf.primitives[i]);
      if (!triangle.can_block()) {
        sides.cannot_block |= 1u << i;
      } else if (triangle.is_in_front()) {
        sides.in_front |= 1u << i;
      }
    }
    return sides;
  }

  const Leaf* const (&leaves_)[kCount];
  Floats u_, v_, distance_;
  Floats turn_;  // sign bit
  Floats edge_slack_, own_slack_;
  std::uint32_t candidates_ = kAllTriangles;
  std::uint32_t unsure_sides_;
  std::uint32_t holed_ = 0;
};

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
