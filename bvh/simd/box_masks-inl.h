// Boxes of a node against rays. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_BOX_MASKS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_BOX_MASKS_INL_H_
#undef LKAO_BVH_SIMD_BOX_MASKS_INL_H_
#else
#define LKAO_BVH_SIMD_BOX_MASKS_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include <hwy/highway.h>

#include "bvh/layout.h"
#include "bvh/ray_box.h"
#include "bvh/simd/ray_parts-inl.h"
#include "bvh/simd/ray_sets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

// Of one ray: the slab test of may_meet for as many children as a vector holds, from `first` on, with the face that the
// ray meets first found by its sign. `origin(face, axis)`: Query::face_origins. From `enter` to `leave`, as shares.
template <class Origin>
HWY_INLINE hn::Mask<BoxTag> children_met(const Node& node, int first, const float (&inverse)[3], const Origin& origin,
                                         hn::Vec<BoxTag> enter, hn::Vec<BoxTag> leave) {
  const BoxTag tag;
  for (int axis = 0; axis < 3; ++axis) {
    const auto by = hn::Set(tag, inverse[axis]);
    const std::uint32_t down = std::bit_cast<std::uint32_t>(inverse[axis]) >> 31;
    const auto at = [&](std::uint32_t face) HWY_ATTR {
      const auto from = hn::Set(tag, origin(face, axis));
      return hn::Mul(hn::Sub(hn::Load(tag, node.faces[face][axis] + first), from), by);
    };
    enter = hn::Max(enter, at(down));
    leave = hn::Min(leave, at(1 - down));
  }
  return hn::Le(enter, hn::Mul(leave, hn::Set(tag, 1.0f + kBoxSlack)));
}

// The boxes of a node's children, relative to the origin of the rays: centers and half sizes. Where the origin is only
// known to be somewhere, they are larger by as much.
template <class Parts>
class RelativeBoxes {
 public:
  RelativeBoxes() = default;  // to be assigned to
  // Of the children, only those where the query's rays count, above the horizon, are of use: see reached().
  HWY_INLINE RelativeBoxes(const Node& node, const Query& query) {
    const BoxTag tag;
    const float near = query.near(), far = query.far();
    const glm::vec3& up = query.rays.up;
    const auto zero = hn::Zero(tag), half = hn::Set(tag, 0.5f), slack = hn::Set(tag, kBoxSlack);
    // Less than infinity, where the empty children are.
    const auto reach2 = hn::Set(tag, std::min(far * far * (1.0f + 2 * kBoxSlack), std::numeric_limits<float>::max()));
    const auto least2 = hn::Set(tag, near * near * (1.0f - 2 * kBoxSlack));
    for (int i = 0; i < kWidth; i += lane_count(tag)) {
      auto distance2 = zero, farthest2 = zero, highest = zero, magnitude = zero;
      for (int axis = 0; axis < 3; ++axis) {
        const auto lower = hn::Sub(hn::Load(tag, node.faces[0][axis] + i), hn::Set(tag, query.face_origins[0][axis])),
                   upper = hn::Sub(hn::Load(tag, node.faces[1][axis] + i), hn::Set(tag, query.face_origins[1][axis]));
        // As is_out_of_reach says. Empty children are.
        const auto gap = hn::Max(zero, hn::Max(lower, hn::Neg(upper)));
        distance2 = hn::MulAdd(gap, gap, distance2);
        if constexpr (Parts::kHasParts) {
          farthest2 = hn::Add(farthest2, hn::Max(hn::Mul(lower, lower), hn::Mul(upper, upper)));
        }
        const auto up_axis = hn::Set(tag, up[axis]);
        const auto height_of_lower = hn::Mul(up_axis, lower), height_of_upper = hn::Mul(up_axis, upper);
        highest = hn::Add(highest, hn::Max(height_of_lower, height_of_upper));
        magnitude = hn::Add(magnitude, hn::Max(hn::Abs(height_of_lower), hn::Abs(height_of_upper)));

        // Rounding in all that follows moves a face by less than 2^-20 of the distance of the farther face.
        const auto center = hn::Mul(half, hn::Add(lower, upper)), half_size = hn::Mul(half, hn::Sub(upper, lower));
        hn::Store(center, tag, center_[axis] + i);
        hn::Store(hn::MulAdd(slack, hn::Add(hn::Abs(center), half_size), half_size), tag, half_size_[axis] + i);
      }
      inside_ |= bits_of(tag, hn::Eq(distance2, zero)) << i;
      auto within = hn::Le(distance2, reach2);
      if constexpr (Parts::kHasParts) within = hn::And(within, hn::Ge(farthest2, least2));
      const auto above = hn::Ge(highest, hn::Neg(hn::Mul(magnitude, slack)));
      reached_ |= bits_of(tag, hn::And(within, above)) << i;
    }
    inside_ &= reached_;
  }

  // Children that rays may reach.
  std::uint32_t reached() const { return reached_; }

  // Leaves out the others.
  void keep(std::uint32_t children) {
    reached_ &= children;
    inside_ &= children;
  }

  // Of those, children whose boxes hold the origin: all rays meet them, for parts of rays all may.
  std::uint32_t holding_origin() const { return inside_; }

  // Faces of a child's box, a little outside of where they are.
  float lower(int axis, int child) const { return center_[axis][child] - half_size_[axis][child]; }
  float upper(int axis, int child) const { return center_[axis][child] + half_size_[axis][child]; }
  float center_distance2(int child) const {
    return center_[0][child] * center_[0][child] + center_[1][child] * center_[1][child] +
           center_[2][child] * center_[2][child];
  }
  // The same of as many children as a vector holds, from `first` on.
  HWY_INLINE hn::Vec<BoxTag> lowers(int axis, int first) const {
    const BoxTag tag;
    return hn::Sub(hn::Load(tag, center_[axis] + first), hn::Load(tag, half_size_[axis] + first));
  }
  HWY_INLINE hn::Vec<BoxTag> uppers(int axis, int first) const {
    const BoxTag tag;
    return hn::Add(hn::Load(tag, center_[axis] + first), hn::Load(tag, half_size_[axis] + first));
  }

  // Where all rays go down an axis, or all up, along each of them: finds which faces they meet first.
  HWY_INLINE void sort_faces(const bool (&goes_down)[3]) {
    const BoxTag tag;
    for (int axis = 0; axis < 3; ++axis) {
      const auto turn = goes_down[axis] ? hn::SignBit(tag) : hn::Zero(tag);
      for (int i = 0; i < kWidth; i += lane_count(tag)) {
        const auto center = hn::Load(tag, center_[axis] + i);
        const auto half_size = hn::Xor(hn::Load(tag, half_size_[axis] + i), turn);
        hn::Store(hn::Sub(center, half_size), tag, first_face_[axis] + i);
        hn::Store(hn::Add(center, half_size), tag, second_face_[axis] + i);
      }
    }
  }

  // Of the 16 rays of a chunk, those that may meet a child's box within their length. As may_meet.
  template <class Rays>
  HWY_INLINE std::uint32_t rays_meeting(int child, const Rays& rays, const Parts& parts, int chunk) const {
    return rays_in(parts, chunk, [&](int first, RayFloats begin, RayFloats end) HWY_ATTR {
      return range(child, rays, first, begin, end);
    });
  }

  // The same for less: only after sort_faces().
  HWY_INLINE std::uint32_t rays_of_signs_meeting(int child, const RaySet& rays, const Parts& parts, int chunk) const {
    const RayTag tag;
    const auto enter = [&](int axis, RayFloats by)
                           HWY_ATTR { return hn::Mul(hn::Set(tag, first_face_[axis][child]), by); };
    const auto leave = [&](int axis, RayFloats by)
                           HWY_ATTR { return hn::Mul(hn::Set(tag, second_face_[axis][child]), by); };
    return rays_in(parts, chunk, [&](int first, RayFloats begin, RayFloats end) HWY_ATTR {
      return range_between(rays, first, begin, end, enter, leave);
    });
  }

  // Where the 16 rays of a chunk enter and leave a child's box, as shares of them: no later, and no sooner.
  template <class Rays>
  HWY_INLINE void find_range(int child, const Rays& rays, int chunk, float* enter, float* leave) const {
    const RayTag tag;
    for (int i = 0; i < kLaneCount; i += lane_count(tag)) {
      const Range all = range(child, rays, chunk * kLaneCount + i, hn::Zero(tag), hn::Set(tag, 1.0f));
      hn::Store(all.enter, tag, enter + i);
      hn::Store(all.leave, tag, leave + i);
    }
  }

 private:
  using RayFloats = hn::Vec<RayTag>;
  struct Range {
    RayFloats enter, leave;
  };

  // Of a vector of rays from `first` on, from `begin` to `end`: what lies between where they enter the slabs of all
  // axes and where they leave them. `enter(axis, by)`, `leave(axis, by)`: of one slab, by the rays' reciprocals.
  template <class Rays, class Enter, class Leave>
  static HWY_INLINE Range range_between(const Rays& rays, int first, RayFloats begin, RayFloats end, const Enter& enter,
                                        const Leave& leave) {
    const RayTag tag;
    const auto x = hn::Load(tag, rays.inverse_x + first), y = hn::Load(tag, rays.inverse_y + first),
               z = hn::Load(tag, rays.inverse_z + first);
    return {hn::Max(hn::Max(enter(0, x), enter(1, y)), hn::Max(enter(2, z), begin)),
            hn::Min(hn::Min(leave(0, x), leave(1, y)), hn::Min(leave(2, z), end))};
  }

  template <class Rays>
  HWY_INLINE Range range(int child, const Rays& rays, int first, RayFloats begin, RayFloats end) const {
    const RayTag tag;
    const auto size = [&](int axis) HWY_ATTR { return hn::Set(tag, half_size_[axis][child]); };
    const auto to = [&](int axis, RayFloats by) HWY_ATTR { return hn::Mul(hn::Set(tag, center_[axis][child]), by); };
    const auto enter = [&](int axis, RayFloats by)
                           HWY_ATTR { return hn::NegMulAdd(size(axis), hn::Abs(by), to(axis, by)); };
    const auto leave = [&](int axis, RayFloats by)
                           HWY_ATTR { return hn::MulAdd(size(axis), hn::Abs(by), to(axis, by)); };
    return range_between(rays, first, begin, end, enter, leave);
  }

  // Those rays of a chunk of which `range(first, begin, end)` leaves something.
  template <class RangeOf>
  static HWY_INLINE std::uint32_t rays_in(const Parts& parts, int chunk, const RangeOf& range_of) {
    const RayTag tag;
    std::uint32_t missed = 0;
    for (int i = 0; i < kLaneCount; i += lane_count(tag)) {
      const int first = chunk * kLaneCount + i;
      const Range left = range_of(first, parts.begin(tag, first), parts.end(tag, first));
      missed |= bits_of(tag, hn::Gt(left.enter, left.leave)) << i;
    }
    return ~missed;
  }

  alignas(64) float center_[3][kWidth];
  alignas(64) float half_size_[3][kWidth];
  alignas(64) float first_face_[3][kWidth], second_face_[3][kWidth];  // by sort_faces()
  std::uint32_t reached_ = 0, inside_ = 0;
};

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
