// How many rays the questions of a suite have.
#pragma once

#include <vector>

#include <gtest/gtest.h>

#include "support/sanitized.h"

namespace lkao::tests {

// Parameters of a suite. Under sanitizers those of one word, and of several words with cones (from 256 rays on); other
// numbers run the same lines, and tests/query asks them of each kernel.
inline auto ray_counts(std::vector<int> counts) {
  if (kIsSanitized) std::erase_if(counts, [](int count) { return count != 64 && count != 256; });
  return testing::ValuesIn(counts);
}

}  // namespace lkao::tests
