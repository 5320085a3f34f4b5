// The lanes of a vector's mask as bits. Included once for each SIMD target.
#if defined(LKAO_LUT_SIMD_MASK_BITS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_LUT_SIMD_MASK_BITS_INL_H_
#undef LKAO_LUT_SIMD_MASK_BITS_INL_H_
#else
#define LKAO_LUT_SIMD_MASK_BITS_INL_H_
#endif

#include <cstdint>
#include <cstring>
#include <type_traits>

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

// The same as a longer number. bits_of() is not to be converted to it: where registers are short, GCC 12 may store the
// byte of an AVX-512 mask and load 64 bits, whatever lies behind it.
template <class Tag, class Mask>
HWY_INLINE std::uint64_t long_bits_of(Tag tag, Mask mask) {
  constexpr bool kIsByte = hwy::HWY_NAMESPACE::MaxLanes(Tag()) <= 8;
  auto bits = static_cast<std::conditional_t<kIsByte, std::uint8_t, std::uint16_t>>(bits_of(tag, mask));
#if HWY_COMPILER_GCC_ACTUAL
  asm("" : "+r"(bits));  // no instruction: puts it into a register of its own length
#endif
  return bits;
}

}  // namespace lkao::lut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
