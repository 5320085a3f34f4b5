// Handles: each of its own object, and of none when that is gone.
#include "c_api/handle_table.h"

#include <atomic>
#include <set>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "c_api/errors.h"

namespace lkao::c_api {
namespace {

bool is_alive(Kind kind, std::uintptr_t handle) {
  try {
    return find(kind, handle, "handle") != nullptr;
  } catch (const Error&) {
    return false;
  }
}

TEST(HandleTable, HoldsMoreThanItsFirstBlock) {
  const std::size_t before = live_count();
  std::vector<int> objects(5000);
  std::vector<std::uintptr_t> handles;
  handles.reserve(objects.size());
  for (int& object : objects) handles.push_back(enter(Kind::bvh, &object));
  EXPECT_EQ(std::set(handles.begin(), handles.end()).size(), objects.size());
  EXPECT_EQ(live_count(), before + objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) ASSERT_EQ(find(Kind::bvh, handles[i], "handle"), &objects[i]);
  for (std::size_t i = 0; i < objects.size(); ++i) ASSERT_EQ(take(Kind::bvh, handles[i], "handle"), &objects[i]);
  for (const std::uintptr_t handle : handles) ASSERT_FALSE(is_alive(Kind::bvh, handle));
  EXPECT_EQ(live_count(), before);
}

TEST(HandleTable, PlacesAreUsedAgainAndOldHandlesAreNot) {
  int object = 0;
  std::set<std::uintptr_t> seen;
  for (int i = 0; i < 1000; ++i) {
    const std::uintptr_t handle = enter(Kind::ao, &object);
    ASSERT_TRUE(seen.insert(handle).second);
    ASSERT_TRUE(is_alive(Kind::ao, handle));
    ASSERT_FALSE(is_alive(Kind::table, handle));
    take(Kind::ao, handle, "handle");
    ASSERT_THROW(take(Kind::ao, handle, "handle"), Error);
  }
  for (const std::uintptr_t handle : seen) ASSERT_FALSE(is_alive(Kind::ao, handle));
}

TEST(HandleTable, NumbersThatAreNoHandlesAreTold) {
  int object = 0;
  const std::uintptr_t handle = enter(Kind::pattern, &object);
  for (int bit = 0; bit < static_cast<int>(8 * sizeof(handle)); ++bit) {
    EXPECT_FALSE(is_alive(Kind::pattern, handle ^ std::uintptr_t{1} << bit)) << bit;
  }
  EXPECT_FALSE(is_alive(Kind::pattern, reinterpret_cast<std::uintptr_t>(&object)));
  EXPECT_FALSE(is_alive(Kind::pattern, ~std::uintptr_t{0}));
  take(Kind::pattern, handle, "handle");
}

TEST(HandleTable, IsSharedByThreads) {
  const std::size_t before = live_count();
  std::atomic<int> wrong_count = 0;
  std::vector<std::thread> threads;
  threads.reserve(4);
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&wrong_count] {
      std::vector<int> objects(300);
      std::vector<std::uintptr_t> handles(objects.size());
      for (int round = 0; round < 20; ++round) {
        for (std::size_t i = 0; i < objects.size(); ++i) handles[i] = enter(Kind::neighbourhood, &objects[i]);
        for (std::size_t i = 0; i < objects.size(); ++i) {
          wrong_count += find(Kind::neighbourhood, handles[i], "handle") != &objects[i];
          wrong_count += take(Kind::neighbourhood, handles[i], "handle") != &objects[i];
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong_count, 0);
  EXPECT_EQ(live_count(), before);
}

}  // namespace
}  // namespace lkao::c_api
