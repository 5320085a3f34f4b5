// Vectors of rays, boxes and triangles, and their masks as bits. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_LANES_INL_H_
#undef LKAO_BVH_SIMD_LANES_INL_H_
#else
#define LKAO_BVH_SIMD_LANES_INL_H_
#endif

#include <bit>
#include <cstdint>
#include <cstring>

#include <hwy/highway.h>

#include "bvh/lane_lists.h"
#include "bvh/layout.h"
#include "lut/simd/mask_bits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Rays are taken 16 at a time, a chunk, whatever the width of a vector; a mask of them fits 16 bits.
inline constexpr int kLaneCount = 16;
using RayTag = hn::CappedTag<float, kLaneCount>;
using BoxTag = hn::CappedTag<float, kWidth>;

template <class Tag>
constexpr int lane_count(Tag tag) {
  return static_cast<int>(hn::Lanes(tag));
}

using lut::HWY_NAMESPACE::bits_of;
using lut::HWY_NAMESPACE::long_bits_of;

// The mask of such bits.
template <class Tag>
HWY_INLINE hn::Mask<Tag> mask_of(Tag tag, std::uint32_t bits) {
  std::uint8_t bytes[8];
  std::memcpy(bytes, &bits, sizeof(bits));
  return hn::LoadMaskBits(tag, bytes);
}

// Within 2^-21 of 1 / v.
template <class Tag>
HWY_INLINE hn::Vec<Tag> reciprocal(Tag tag, hn::Vec<Tag> v) {
  auto inverse = hn::ApproximateReciprocal(v);
  // Newton: the estimate may have as few as 8 bits.
  for (int step = 0; step < 2; ++step) inverse = hn::Mul(inverse, hn::NegMulAdd(v, inverse, hn::Set(tag, 2.0f)));
  return inverse;
}

// Stores the lanes whose bit is set one after the other, and some garbage behind them: a whole vector in all. Returns
// how many they are.
template <class Tag>
HWY_INLINE int store_packed(Tag tag, hn::Vec<Tag> values, std::uint32_t lanes, std::uint32_t* to) {
#if HWY_TARGET == HWY_AVX2  // Highway's own way is slow there
  if constexpr (hn::MaxLanes(Tag()) == 8) {
    const hn::Rebind<std::uint8_t, Tag> byte_tag;
    const auto numbers = hn::PromoteTo(hn::RebindToSigned<Tag>(), hn::Load(byte_tag, kLaneLists[lanes]));
    hn::StoreU(hn::TableLookupLanes(values, hn::IndicesFromVec(tag, numbers)), tag, to);
    return std::popcount(lanes);
  }
#endif
  hn::StoreU(hn::Compress(values, mask_of(tag, lanes)), tag, to);
  return std::popcount(lanes);
}

// The same for the lanes of a mask.
template <class Tag>
HWY_INLINE int store_packed(Tag tag, hn::Vec<Tag> values, hn::Mask<Tag> mask, std::uint32_t* to) {
#if HWY_TARGET == HWY_AVX2
  return store_packed(tag, values, bits_of(tag, mask), to);
#else
  hn::StoreU(hn::Compress(values, mask), tag, to);
  return static_cast<int>(hn::CountTrue(tag, mask));
#endif
}

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
