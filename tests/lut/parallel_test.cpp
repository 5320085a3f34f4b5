#include "lut/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <vector>

namespace lkao::lut {
namespace {

TEST(ForEachPart, ReachesEveryIndexOnce) {
  for (const int thread_count : {0, 1, 2, 7}) {
    for (const std::uint32_t count : {0u, 1u, 5u, 64u, 65u, 1000u}) {
      for (const std::uint32_t grain : {1u, 64u, 5000u}) {
        std::vector<std::atomic<int>> visits(count);
        for_each_part(count, grain, thread_count, [&](std::uint32_t first, std::uint32_t last) {
          EXPECT_LT(first, last);
          EXPECT_LE(last - first, grain);
          for (std::uint32_t i = first; i < last; ++i) ++visits[i];
        });
        for (const std::atomic<int>& visit : visits) EXPECT_EQ(visit, 1);
      }
    }
  }
}

TEST(ForEachPart, TakesCountsUpToTheLargest) {
  constexpr std::uint32_t kLargest = 0xffffffffu;
  std::atomic<std::uint64_t> sum{0};
  for_each_part(kLargest, 0x80000000u, 2, [&](std::uint32_t first, std::uint32_t last) { sum += last - first; });
  EXPECT_EQ(sum, kLargest);
}

}  // namespace
}  // namespace lkao::lut
