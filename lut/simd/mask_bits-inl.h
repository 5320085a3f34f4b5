// The lanes of a vector's mask as bits. Included once for each SIMD target.
#if defined(LKAO_LUT_SIMD_MASK_BITS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_LUT_SIMD_MASK_BITS_INL_H_
#undef LKAO_LUT_SIMD_MASK_BITS_INL_H_
#else
#define LKAO_LUT_SIMD_MASK_BITS_INL_H_
#endif

#include <cstdint>
#include <cstring>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lkao::lut::HWY_NAMESPACE {

// Of at most 16 lanes. Reads just the bytes that were stored, so that no memory is touched in the end.
template <class Tag, class Mask>
HWY_INLINE std::uint32_t bits_of(Tag tag, Mask mask) {
  std::uint8_t bytes[8];
  hwy::HWY_NAMESPACE::StoreMaskBits(tag, mask, bytes);
  if constexpr (hwy::HWY_NAMESPACE::MaxLanes(Tag()) > 8) {
    std::uint16_t bits;
    std::memcpy(&bits, bytes, sizeof(bits));
    return bits;
  } else {
    return bytes[0];
  }
}

}  // namespace lkao::lut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
