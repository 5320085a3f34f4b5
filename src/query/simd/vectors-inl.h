// Vectors of the rays of a receiver, many at once, without fused multiply-adds: every instruction set gives the same
// bits. Included once for each SIMD target.
#if defined(LKAO_QUERY_SIMD_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_QUERY_SIMD_VECTORS_INL_H_
#undef LKAO_QUERY_SIMD_VECTORS_INL_H_
#else
#define LKAO_QUERY_SIMD_VECTORS_INL_H_
#endif

#include <glm/vec3.hpp>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lkao::query::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, 16>;
using Floats = hn::Vec<Tag>;

struct Vector {
  Floats x, y, z;
};

HWY_INLINE Vector splat(const glm::vec3& v) {
  const Tag tag;
  return {hn::Set(tag, v.x), hn::Set(tag, v.y), hn::Set(tag, v.z)};
}

HWY_INLINE Floats dot(const Vector& a, const Vector& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

}  // namespace lkao::query::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
