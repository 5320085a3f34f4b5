// Long calls are watched and stopped.
#include "lkao/progress.h"

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "lkao/lkao.h"
#include "support/meshes.h"
#include "support/receivers.h"

namespace lkao {
namespace {

// Notes what it is told, and stops the call once so much is done.
struct Watcher {
  bool operator()(std::size_t done, std::size_t total) {
    EXPECT_GT(done, last_done);
    EXPECT_LE(done, total);
    last_done = done;
    last_total = total;
    ++call_count;
    return done < stop_at;
  }

  std::size_t stop_at = static_cast<std::size_t>(-1);
  std::size_t last_done = 0, last_total = 0, call_count = 0;
};

struct Batch {
  tests::Mesh mesh = tests::random_soup(2000, 0.1f, 3);
  AmbientOcclusion ao{OccluderBvh(mesh.view()), SamplePattern::standard(64), {.radius = 0.5f}};
  std::vector<Receiver> receivers = tests::random_receivers(1000, 1, 4);
  std::vector<float> occlusion = std::vector<float>(1000, -1.0f);
};

TEST(Progress, OfABatchReachesTheEnd) {
  Batch batch;
  Watcher watcher;
  const QueryReport report = batch.ao.query(batch.receivers, {.occlusion = batch.occlusion}, 0, std::ref(watcher));
  EXPECT_EQ(report.receiver_count, 1000u);
  EXPECT_EQ(watcher.last_done, 1000u);
  EXPECT_EQ(watcher.last_total, 1000u);
  EXPECT_GT(watcher.call_count, 5u);
}

TEST(Progress, StopsABatchThatHasAnsweredSomeReceivers) {
  Batch batch;
  std::vector<float> expected(1000);
  batch.ao.query(batch.receivers, {.occlusion = expected});
  Watcher watcher{.stop_at = 200};
  EXPECT_THROW(batch.ao.query(batch.receivers, {.occlusion = batch.occlusion}, 0, std::ref(watcher)), Cancelled);
  EXPECT_GE(watcher.last_done, 200u);
  EXPECT_LT(watcher.last_done, 1000u) << "told of more after it had said to stop";
  std::size_t answered_count = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    answered_count += batch.occlusion[i] == expected[i];
    EXPECT_TRUE(batch.occlusion[i] == expected[i] || batch.occlusion[i] == -1.0f) << i;
  }
  EXPECT_GE(answered_count, 200u);
  EXPECT_LT(answered_count, 1000u);
}

TEST(Progress, WhatItThrowsComesOut) {
  Batch batch;
  const Progress thrower = [](std::size_t, std::size_t) -> bool { throw std::domain_error("enough"); };
  EXPECT_THROW(batch.ao.query(batch.receivers, {.occlusion = batch.occlusion}, 0, thrower), std::domain_error);
  EXPECT_THROW(OccluderBvh(batch.mesh.view(), {}, thrower), std::domain_error);
}

TEST(Progress, OfABuildReachesTheEndAndChangesNothing) {
  for (const int triangle_count : {3, 500, 20000}) {
    for (const bool spatial_splits : {true, false}) {
      const tests::Mesh mesh = tests::random_soup(triangle_count, 0.2f, 5);
      Watcher watcher;
      const OccluderBvh watched(mesh.view(), {.spatial_splits = spatial_splits}, std::ref(watcher));
      const OccluderBvh plain(mesh.view(), {.spatial_splits = spatial_splits});
      EXPECT_EQ(watcher.last_done, watcher.last_total) << triangle_count;
      EXPECT_GT(watcher.call_count, triangle_count > 1000 ? 10u : 0u);
      EXPECT_EQ(watched.report().reference_count, plain.report().reference_count);
      EXPECT_EQ(watched.report().node_count, plain.report().node_count);
    }
  }
}

TEST(Progress, StopsABuild) {
  const tests::Mesh mesh = tests::random_soup(20000, 0.2f, 6);
  Watcher watcher{.stop_at = 1};
  EXPECT_THROW(OccluderBvh(mesh.view(), {}, std::ref(watcher)), Cancelled);
  EXPECT_EQ(watcher.call_count, 1u);
}

}  // namespace
}  // namespace lkao
