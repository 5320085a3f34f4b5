#include "bvh/huge_pages.h"

#include <cstdint>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace lkao::bvh {
namespace {

template <typename T>
using Vector = std::vector<T, HugePageAllocator<T>>;

std::uintptr_t address_of(const void* memory) { return reinterpret_cast<std::uintptr_t>(memory); }

TEST(HugePageAllocator, StorageIsAlignedForVectors) {
  for (const std::size_t count : {1u, 3u, 100u, 1000u, 100'000u}) {
    EXPECT_EQ(address_of(Vector<std::uint8_t>(count).data()) % 64, 0u) << count;
  }
}

TEST(HugePageAllocator, LargeStorageBeginsAHugePage) {
  constexpr std::size_t kHugePage = std::size_t{2} << 20;
  for (const std::size_t size : {2 * kHugePage, 2 * kHugePage + 1, 5 * kHugePage - 1}) {
    EXPECT_EQ(address_of(Vector<std::uint8_t>(size).data()) % kHugePage, 0u) << size;
  }
}

TEST(HugePageAllocator, ElementsStayAsTheVectorGrows) {
  Vector<std::uint32_t> values(10);
  std::iota(values.begin(), values.end(), 0u);
  for (std::uint32_t i = 10; i < 3'000'000; ++i) values.push_back(i);  // past the first huge page
  for (std::uint32_t i = 0; i < values.size(); ++i) ASSERT_EQ(values[i], i);
}

TEST(HugePageAllocator, ElementsGetTheirValueWhereThereIsOne) { EXPECT_EQ(Vector<int>(3, 7), (Vector<int>{7, 7, 7})); }

TEST(HugePageAllocator, SizesBeyondTheAddressSpaceThrow) {
  EXPECT_THROW(HugePageAllocator<std::uint64_t>().allocate(std::size_t{1} << 61), std::bad_array_new_length);
}

}  // namespace
}  // namespace lkao::bvh
