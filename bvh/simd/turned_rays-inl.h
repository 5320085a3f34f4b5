// Rays from the world to the space of an instance's mesh. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_TURNED_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_TURNED_RAYS_INL_H_
#undef LKAO_BVH_SIMD_TURNED_RAYS_INL_H_
#else
#define LKAO_BVH_SIMD_TURNED_RAYS_INL_H_
#endif

#include <hwy/highway.h>
#include <glm/mat4x3.hpp>

#include "bvh/simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

// As many neighbouring rays as vectors of double hold, by component. Sums in double, to be rounded once.
class TurnedRays {
 public:
  using DoubleTag = hn::CappedTag<double, 8>;
  using FloatTag = hn::Rebind<float, DoubleTag>;
  using Doubles = hn::Vec<DoubleTag>;
  using Floats = hn::Vec<FloatTag>;

  HWY_INLINE TurnedRays(const glm::dmat4x3& to_mesh, const float* x, const float* y, const float* z) {
    const auto load = [](const float* from) HWY_ATTR { return hn::PromoteTo(DoubleTag(), hn::Load(FloatTag(), from)); };
    const auto rx = load(x), ry = load(y), rz = load(z);
    const auto sum = [&](int row) HWY_ATTR {
      const auto m = [&](int axis) HWY_ATTR { return hn::Set(DoubleTag(), to_mesh[axis][row]); };
      return hn::MulAdd(m(0), rx, hn::MulAdd(m(1), ry, hn::Mul(m(2), rz)));
    };
    x_ = sum(0);
    y_ = sum(1);
    z_ = sum(2);
  }

  Doubles x() const { return x_; }
  Doubles y() const { return y_; }
  Doubles z() const { return z_; }

  // What share of each ray is so long, nearly; of rays so long that floats do not hold their squares it is larger.
  HWY_INLINE Floats share_of(float length) const {
    const FloatTag tag;
    const auto all = hn::MulAdd(x_, x_, hn::MulAdd(y_, y_, hn::Mul(z_, z_)));
    const auto length2 = hn::DemoteTo(tag, hn::Min(all, hn::Set(DoubleTag(), 1e38)));
    return hn::Mul(hn::Set(tag, length), hn::ApproximateReciprocalSqrt(hn::Max(length2, hn::Set(tag, 1e-36f))));
  }

 private:
  Doubles x_, y_, z_;
};

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
