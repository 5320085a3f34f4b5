// Triangles of a leaf against many rays. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_LEAF_PLANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_LEAF_PLANES_INL_H_
#undef LKAO_BVH_SIMD_LEAF_PLANES_INL_H_
#else
#define LKAO_BVH_SIMD_LEAF_PLANES_INL_H_
#endif

#include <algorithm>
#include <cmath>

#include <hwy/highway.h>

#include "bvh/layout.h"
#include "bvh/simd/chunk_cones-inl.h"
#include "bvh/simd/lanes-inl.h"
#include "bvh/simd/leaf_frames-inl.h"
#include "bvh/simd/ray_parts-inl.h"
#include "bvh/simd/ray_sets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

// Each triangle's planes through the origin, set up once for all rays, and scaled by their error bounds: what they say
// of a ray is certain where it is beyond 1 and -1.
//
// With the rows u = (u_ towards + distance u_gradient) / E and likewise v, t = towards / E, a ray meets the triangle
// where
//   u . ray >= 0,  v . ray >= 0,  (t - u - v) . ray >= 0  and  E / O t . ray >= distance / O.
//
// Error bounds, in the words of LeafFrames: a component of a row has an error of 8 e g |p| |towards| + 8 e |p|
// |gradient|, scaling adds 2 and the sum of three products 3 to both, so u . ray and v . ray are uncertain by (13 + 13
// * 1.7321) e g |p| r = 36 e g |p| r, divided by E. The third edge adds up both, 11 e g |p| r for its sums, and 7 e r
// for t: 83 e g |p| r
// + 7 e r. The edge slack of LeafFrames, 90 e g |p| r + 12 e r, covers it. The own plane is uncertain by 11 e r for t .
// ray times E / O and a part's share, and by 8 e |p| for distance / O; O is 16 e r + 9.6 e |p|.
class LeafPlanes {
 public:
  // `triangles`: those that can block a ray at all, as LeafFrames::reached() finds them.
  template <bool kHasHoles>
  HWY_INLINE LeafPlanes(const LeafFrames<1, kHasHoles>& frames, float radius, std::uint32_t triangles) {
    const LeafTag<1> tag;
    const auto zero = hn::Zero(tag), one = hn::Set(tag, 1.0f), least = hn::Set(tag, 1e-30f);
    // A slack that is no number stays one, as the second operand.
    const auto own_slack = hn::Max(least, hn::Mul(hn::Set(tag, 1.6f), frames.own_slack_)),
               edge_slack = hn::Max(least, frames.edge_slack_);
    // Where rows would leave the range of floats, all rays are in doubt.
    const float most = radius > 1e-25f ? std::min(1e30f * radius, 1e37f) : 0.0f;
    const auto fits = hn::Lt(edge_slack, hn::Set(tag, most));
    const auto edge_scale = hn::IfThenElseZero(fits, hn::Div(one, edge_slack)), own_scale = hn::Div(one, own_slack);
    for (int axis = 0; axis < 3; ++axis) {
      using Frames = LeafFrames<1, kHasHoles>;
      const auto towards = hn::Xor(frames.load(Frames::kBackNormal, axis), frames.turn_);
      const auto row = [&](const auto& origin, auto gradient) HWY_ATTR {
        const auto value = hn::MulAdd(origin, towards, hn::Mul(frames.distance_, frames.load(gradient, axis)));
        return hn::IfThenElseZero(fits, hn::Mul(edge_scale, value));
      };
      hn::Store(towards, tag, normal_[axis]);
      hn::Store(hn::Mul(edge_scale, towards), tag, towards_[axis]);
      hn::Store(row(frames.u_, Frames::kUGradient), tag, u_[axis]);
      hn::Store(row(frames.v_, Frames::kVGradient), tag, v_[axis]);
    }
    // What cannot block a ray is too far away.
    const auto can_block = mask_of(tag, triangles);
    const auto distance = hn::IfThenElseZero(fits, hn::Mul(frames.distance_, own_scale));
    hn::Store(hn::IfThenElse(can_block, distance, hn::Set(tag, 1e30f)), tag, distance_);
    hn::Store(hn::IfThenElseZero(hn::And(can_block, fits), hn::Mul(edge_slack, own_scale)), tag, to_own_);
    hn::Store(hn::IfThenElse(fits, hn::Sub(frames.distance_, own_slack), zero), tag, nearest_);
  }

  // Of the rays of a chunk, those that some triangle blocks.
  template <class Parts>
  HWY_INLINE Verdict blocked(const RaySet& rays, const Parts& parts, int chunk) const {
    return judge(rays, chunk, [&](const auto& x, const auto& y, const auto& z, int first) HWY_ATTR {
      auto most = margin(0, x, y, z, parts, first);
      for (int triangle = 1; triangle < kLeafWidth; ++triangle) {
        most = hn::Max(most, margin(triangle, x, y, z, parts, first));
      }
      return most;
    });
  }

  // The same for one triangle.
  template <class Parts>
  HWY_INLINE Verdict blocked(int triangle, const RaySet& rays, const Parts& parts, int chunk) const {
    return judge(rays, chunk, [&](const auto& x, const auto& y, const auto& z, int first) HWY_ATTR {
      return margin(triangle, x, y, z, parts, first);
    });
  }

  // What is known of a triangle with holes where the rays of a chunk meet it, of those that are sure to: places are
  // those of LeafFrames, in units of the edge slack.
  HWY_INLINE KnownHoles known_holes(const HoleSquares& squares, std::uint32_t primitive, int triangle,
                                    const RaySet& rays, int chunk) const {
    const RayTag tag;
    KnownHoles all;
    for (int i = 0; i < kLaneCount; i += lane_count(tag)) {
      const int first = chunk * kLaneCount + i;
      const auto x = hn::Load(tag, rays.x + first), y = hn::Load(tag, rays.y + first),
                 z = hn::Load(tag, rays.z + first);
      const auto inverse = hn::Div(hn::Set(tag, 1.0f), dot(towards_, triangle, x, y, z));
      const Places<RayTag> places{hn::Mul(dot(u_, triangle, x, y, z), inverse),
                                  hn::Mul(dot(v_, triangle, x, y, z), inverse),
                                  hn::MulAdd(hn::Set(tag, 3.0f), inverse, hn::Set(tag, kPlaceRounding))};
      const KnownHoles some = squares.at(tag, primitive, places);
      all.clear |= some.clear << i;
      all.opaque |= some.opaque << i;
    }
    return all;
  }

  // Chunks of the pattern that may have a ray which meets the triangle, as bits. Rays are no longer than `radius`.
  HWY_INLINE std::uint64_t chunks_meeting(int triangle, const ChunkCones& cones, float radius) const {
    const float nearest = nearest_[triangle];
    if (!(nearest > 0)) return ~std::uint64_t{0};
    float rows[3][3], norms[3];
    for (int axis = 0; axis < 3; ++axis) {
      rows[0][axis] = u_[axis][triangle] * radius;
      rows[1][axis] = v_[axis][triangle] * radius;
      rows[2][axis] = towards_[axis][triangle] * radius - rows[0][axis] - rows[1][axis];
    }
    for (int i = 0; i < 3; ++i) {
      norms[i] = 1.00001f * std::sqrt(rows[i][0] * rows[i][0] + rows[i][1] * rows[i][1] + rows[i][2] * rows[i][2]);
    }
    // A ray that meets the triangle is as long as `nearest`, so one of the length `radius` is no farther outside of an
    // edge than this.
    const float slack = 1.01f * radius / nearest, reach = nearest / radius * 0.9999f - 1e-5f;
    const RayTag tag;
    std::uint64_t chunks = 0;
    for (int i = 0; i < cones.chunk_count(); i += lane_count(tag)) {
      const auto x = cones.axis(0, i), y = cones.axis(1, i), z = cones.axis(2, i);
      const auto cosine = cones.cosine(i), sine = cones.sine(i);
      const auto along = [&](float row_x, float row_y, float row_z) HWY_ATTR {
        return hn::MulAdd(hn::Set(tag, row_x), x, hn::MulAdd(hn::Set(tag, row_y), y, hn::Mul(hn::Set(tag, row_z), z)));
      };
      // No less than for any ray of the cone; positive anyway where the axis is inside the edge.
      const auto most = [&](int k) HWY_ATTR {
        const auto middle = along(rows[k][0], rows[k][1], rows[k][2]);
        const auto spread = hn::MulAdd(hn::Set(tag, norms[k]), sine, hn::Set(tag, slack + norms[k] * 1e-5f));
        return hn::MulAdd(middle, cosine, spread);
      };
      const auto c = along(normal_[0][triangle], normal_[1][triangle], normal_[2][triangle]);
      const auto depth = hn::Sub(hn::Add(hn::Max(c, hn::Mul(c, cosine)), sine), hn::Set(tag, reach));
      const auto least = hn::Min(hn::Min(most(0), most(1)), hn::Min(most(2), depth));
      chunks |= long_bits_of(tag, hn::Ge(least, hn::Zero(tag))) << i;
    }
    return chunks;
  }

 private:
  using RayFloats = hn::Vec<RayTag>;
  static constexpr std::uint32_t kLanes = (1u << hn::MaxLanes(RayTag())) - 1;

  // By how much a ray is beyond all planes of the triangle, the least of them.
  template <class Parts>
  HWY_INLINE RayFloats margin(int triangle, RayFloats x, RayFloats y, RayFloats z, const Parts& parts,
                              int first) const {
    const RayTag tag;
    const auto u = dot(u_, triangle, x, y, z), v = dot(v_, triangle, x, y, z), t = dot(towards_, triangle, x, y, z);
    const auto edges = hn::Min(hn::Min(u, v), hn::Sub(t, hn::Add(u, v)));
    const auto to_own = hn::Set(tag, to_own_[triangle]), distance = hn::Set(tag, distance_[triangle]);
    if constexpr (Parts::kHasParts) {
      const auto towards = hn::Mul(t, to_own);
      const auto within = hn::Min(hn::MulSub(towards, parts.end(tag, first), distance),
                                  hn::NegMulAdd(towards, parts.begin(tag, first), distance));
      return hn::Min(edges, within);
    } else {
      return hn::Min(edges, hn::MulSub(t, to_own, distance));
    }
  }

  template <class Margin>
  static HWY_INLINE Verdict judge(const RaySet& rays, int chunk, const Margin& margin) {
    const RayTag tag;
    const auto one = hn::Set(tag, 1.0f);
    Verdict all{0, 0};
    for (int i = 0; i < kLaneCount; i += lane_count(tag)) {
      const int first = chunk * kLaneCount + i;
      const auto most =
          margin(hn::Load(tag, rays.x + first), hn::Load(tag, rays.y + first), hn::Load(tag, rays.z + first), first);
      all.sure |= bits_of(tag, hn::Gt(most, one)) << i;
      all.perhaps |= (kLanes & ~bits_of(tag, hn::Lt(most, hn::Neg(one)))) << i;
    }
    return all;
  }

  static HWY_INLINE RayFloats dot(const float (&rows)[3][kLeafWidth], int triangle, RayFloats x, RayFloats y,
                                  RayFloats z) {
    const RayTag tag;
    return hn::MulAdd(hn::Set(tag, rows[0][triangle]), x,
                      hn::MulAdd(hn::Set(tag, rows[1][triangle]), y, hn::Mul(hn::Set(tag, rows[2][triangle]), z)));
  }

  // By axis, then triangle.
  alignas(64) float u_[3][kLeafWidth], v_[3][kLeafWidth], towards_[3][kLeafWidth], normal_[3][kLeafWidth];
  alignas(64) float to_own_[kLeafWidth], distance_[kLeafWidth];
  alignas(64) float nearest_[kLeafWidth];  // no ray that meets the triangle is shorter; 0 where that is not known
};

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
