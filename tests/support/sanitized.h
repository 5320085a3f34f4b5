// Whether this program looks for mistakes in memory: then comparisons of whole pictures may be of smaller ones, since
// all lines run just as well.
#pragma once

namespace lkao::tests {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool kIsSanitized = true;
#elif defined(__clang__)
inline constexpr bool kIsSanitized = __has_feature(address_sanitizer);
#else
inline constexpr bool kIsSanitized = false;
#endif

}  // namespace lkao::tests
