// Whether this program looks for mistakes in memory. Then what would only be another case of the same lines is left
// out: whether numbers are right is seen without sanitizers.
#pragma once

namespace lkao::tests {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool kIsSanitized = true;
#elif defined(__clang__)
inline constexpr bool kIsSanitized = __has_feature(address_sanitizer);
#else
inline constexpr bool kIsSanitized = false;
#endif

// The size of a picture, a number of repetitions: as usual, and under sanitizers.
template <typename T>
constexpr T unless_sanitized(const T& usual, const T& sanitized) {
  return kIsSanitized ? sanitized : usual;
}

}  // namespace lkao::tests
