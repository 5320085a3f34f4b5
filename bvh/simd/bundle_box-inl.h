// Boxes of a node against all rays at once, where those are a narrow bundle. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_BUNDLE_BOX_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_BUNDLE_BOX_INL_H_
#undef LKAO_BVH_SIMD_BUNDLE_BOX_INL_H_
#else
#define LKAO_BVH_SIMD_BUNDLE_BOX_INL_H_
#endif

#include <algorithm>
#include <cstdint>

#include <hwy/highway.h>

#include "bvh/layout.h"
#include "bvh/pattern_cones.h"
#include "bvh/simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

// Each component of all rays is known to lie within an interval. A box that lies on one side of the origin along an
// axis is then entered by no ray sooner than its near face divided by the largest component, and left by none later
// than its far face divided by the smallest: an interval of shares of the rays. Those of three axes must overlap.
class BundleBox {
 public:
  BundleBox(const PatternCones& cones, float radius) : is_of_use_(cones.is_bundle) {
    if (!is_of_use_) return;
    has_signs_ = true;
    // No product with a face may overflow, and what goes no way along an axis, or both ways, is to say nothing.
    const float shortest = std::max(radius * 0x1p-40f, 0.5f * Node::kMargin);
    shortest_ = shortest * 0x1p20f;
    for (int axis = 0; axis < 3; ++axis) {
      const float least = cones.least[axis], most = cones.most[axis];
      goes_down_[axis] = most < 0;
      has_signs_ = has_signs_ && (least > 0 || most < 0);
      soonest_[0][axis] = 1 / std::max(most, shortest);
      soonest_[1][axis] = 1 / std::max(-least, shortest);
      latest_[0][axis] = kSlack / std::max(least, shortest);
      latest_[1][axis] = kSlack / std::max(-most, shortest);
    }
  }

  bool is_of_use() const { return is_of_use_; }
  // True where all rays go the same way along each axis: down it, or up.
  bool has_signs() const { return has_signs_; }
  const bool (&goes_down() const)[3] { return goes_down_; }

  // Children whose boxes some ray may meet, as bits.
  template <class Boxes>
  HWY_INLINE std::uint32_t met(const Boxes& boxes) const {
    const BoxTag tag;
    const auto zero = hn::Zero(tag), shortest = hn::Set(tag, shortest_);
    std::uint32_t children = 0;
    for (int i = 0; i < kWidth; i += lane_count(tag)) {
      auto enter = zero, leave = hn::Set(tag, kSlack);
      for (int axis = 0; axis < 3; ++axis) {
        const auto lower = boxes.lowers(axis, i), upper = boxes.uppers(axis, i);
        enter = hn::Max(enter, hn::Mul(lower, hn::Set(tag, soonest_[0][axis])));
        enter = hn::Max(enter, hn::Mul(hn::Neg(upper), hn::Set(tag, soonest_[1][axis])));
        leave = hn::Min(leave, hn::Mul(hn::Max(upper, shortest), hn::Set(tag, latest_[0][axis])));
        leave = hn::Min(leave, hn::Mul(hn::Max(hn::Neg(lower), shortest), hn::Set(tag, latest_[1][axis])));
      }
      children |= bits_of(tag, hn::Le(enter, leave)) << i;
    }
    return children;
  }

 private:
  static constexpr float kSlack = 1.0f + 0x1p-16f;

  bool is_of_use_;
  bool has_signs_ = false;
  bool goes_down_[3] = {};
  float shortest_ = 0;
  // By direction (up or down the axis) and axis: 1 / component.
  float soonest_[2][3], latest_[2][3];
};

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
