// Boxes of a node against rays. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_BOX_MASKS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_BOX_MASKS_INL_H_
#undef LKAO_BVH_SIMD_BOX_MASKS_INL_H_
#else
#define LKAO_BVH_SIMD_BOX_MASKS_INL_H_
#endif

#include <hwy/highway.h>

#include "bvh/layout.h"
#include "bvh/simd/ray_sets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

// The faces of the boxes of a node's children, relative to the origin of the rays.
class RelativeBoxes {
 public:
  HWY_INLINE RelativeBoxes(const Node& node, const glm::vec3& origin) {
    const BoxTag tag;
    for (int axis = 0; axis < 3; ++axis) {
      const auto from = hn::Set(tag, origin[axis]);
      for (int i = 0; i < kWidth; i += lane_count(tag)) {
        hn::Store(hn::Sub(hn::Load(tag, node.faces[0][axis] + i), from), tag, faces_[0][axis] + i);
        hn::Store(hn::Sub(hn::Load(tag, node.faces[1][axis] + i), from), tag, faces_[1][axis] + i);
      }
    }
  }

  // Children that are not out of reach, as is_out_of_reach says. Empty children are.
  HWY_INLINE std::uint32_t within_reach(const glm::vec3& up, float radius) const {
    const BoxTag tag;
    const auto zero = hn::Zero(tag), reach2 = hn::Set(tag, radius * radius * (1.0f + 0x1p-19f));
    const auto slack = hn::Set(tag, 0x1p-20f);
    std::uint32_t children = 0;
    for (int i = 0; i < kWidth; i += lane_count(tag)) {
      auto distance2 = zero, highest = zero, magnitude = zero;
      for (int axis = 0; axis < 3; ++axis) {
        const auto lower = hn::Load(tag, faces_[0][axis] + i), upper = hn::Load(tag, faces_[1][axis] + i);
        const auto gap = hn::Max(zero, hn::Max(lower, hn::Neg(upper)));
        distance2 = hn::MulAdd(gap, gap, distance2);
        const auto up_axis = hn::Set(tag, up[axis]);
        const auto height_of_lower = hn::Mul(up_axis, lower), height_of_upper = hn::Mul(up_axis, upper);
        highest = hn::Add(highest, hn::Max(height_of_lower, height_of_upper));
        magnitude = hn::Add(magnitude, hn::Max(hn::Abs(height_of_lower), hn::Abs(height_of_upper)));
      }
      const auto near = hn::Le(distance2, reach2);
      const auto above = hn::Ge(highest, hn::Neg(hn::Mul(magnitude, slack)));
      children |= bits_of(tag, hn::And(near, above)) << i;
    }
    return children;
  }

  // Of 16 rays, those that may meet a child's box within their length. As may_meet.
  HWY_INLINE std::uint32_t rays_meeting(int child, const RaySet& rays) const {
    const RayTag tag;
    const auto zero = hn::Zero(tag), one = hn::Set(tag, 1.0f), slack = hn::Set(tag, kBoxSlack);
    std::uint32_t met = 0;
    for (int i = 0; i < kLaneCount; i += lane_count(tag)) {
      const auto inverse_x = hn::LoadU(tag, rays.inverse_x + i), inverse_y = hn::LoadU(tag, rays.inverse_y + i),
                 inverse_z = hn::LoadU(tag, rays.inverse_z + i);
      const auto x0 = hn::Mul(hn::Set(tag, faces_[0][0][child]), inverse_x);
      const auto x1 = hn::Mul(hn::Set(tag, faces_[1][0][child]), inverse_x);
      const auto y0 = hn::Mul(hn::Set(tag, faces_[0][1][child]), inverse_y);
      const auto y1 = hn::Mul(hn::Set(tag, faces_[1][1][child]), inverse_y);
      const auto z0 = hn::Mul(hn::Set(tag, faces_[0][2][child]), inverse_z);
      const auto z1 = hn::Mul(hn::Set(tag, faces_[1][2][child]), inverse_z);
      const auto enter = hn::Max(hn::Max(hn::Min(x0, x1), hn::Min(y0, y1)), hn::Max(hn::Min(z0, z1), zero));
      const auto leave = hn::Min(hn::Min(hn::Max(x0, x1), hn::Max(y0, y1)), hn::Min(hn::Max(z0, z1), one));
      met |= bits_of(tag, hn::Le(enter, hn::Mul(leave, slack))) << i;
    }
    return met;
  }

 private:
  alignas(64) float faces_[2][3][kWidth];  // lower and upper, by axis, then child
};

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
