#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "reference/embree_reference.h"

namespace lkao::reference {
namespace {

using Words = std::vector<std::uint64_t>;

TEST(CountMismatchedRays, CountsBitsThatDiffer) {
  EXPECT_EQ(count_mismatched_rays(Words{}, Words{}), 0u);
  EXPECT_EQ(count_mismatched_rays(Words{5, 9}, Words{5, 9}), 0u);
  EXPECT_EQ(count_mismatched_rays(Words{0b1100, 0}, Words{0b1010, ~std::uint64_t{0}}), 66u);
}

TEST(CountMismatchedRays, ThrowsWhereSizesDiffer) {
  EXPECT_THROW(count_mismatched_rays(Words{1}, Words{1, 2}), std::invalid_argument);
}

}  // namespace
}  // namespace lkao::reference
