#include <bit>
#include <stdexcept>

#include <fmt/format.h>

#include "reference/embree_reference.h"

namespace lkao::reference {

std::uint64_t count_mismatched_rays(std::span<const std::uint64_t> mask_words_a,
                                    std::span<const std::uint64_t> mask_words_b) {
  if (mask_words_a.size() != mask_words_b.size()) {
    throw std::invalid_argument(
        fmt::format("cannot compare {} mask words with {}", mask_words_a.size(), mask_words_b.size()));
  }
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < mask_words_a.size(); ++i) {
    count += static_cast<std::uint64_t>(std::popcount(mask_words_a[i] ^ mask_words_b[i]));
  }
  return count;
}

}  // namespace lkao::reference
