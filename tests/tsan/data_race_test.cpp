// What must be free of data races: made to be run by the thread sanitizer, and correct without it.
//
// oneTBB comes as a library that is not instrumented, so the sanitizer sees what its threads hand to each other only
// where a thread starts and where it is joined. Each test therefore begins without workers and joins them before it
// reads what they wrote.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <thread>
#include <vector>

#include "lkao/lkao.h"

namespace lkao {
namespace {

constexpr int kThreadCount = 4;
constexpr int kReceiverCount = 1000;

// Calls `work` with kThreadCount threads of oneTBB and joins the workers.
template <typename Work>
bool run_and_join_workers(const Work& work) {
  oneapi::tbb::task_scheduler_handle scheduler{oneapi::tbb::attach{}};
  {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, kThreadCount);
    oneapi::tbb::task_arena arena(kThreadCount);
    arena.execute(work);
  }
  return oneapi::tbb::finalize(scheduler, std::nothrow);
}

// At a radius where rays meet little, and without end: then nearly all are blocked, and threads remember by what.
class DataRace : public ::testing::TestWithParam<float> {
 protected:
  void SetUp() override {
    std::mt19937 random(1);
    const auto coordinate = [&random] { return static_cast<float>(random()) / 2147483648.0f - 1.0f; };
    const auto point = [&coordinate] { return glm::vec3(coordinate(), coordinate(), coordinate()); };
    std::vector<glm::uvec3> triangles;
    for (std::uint32_t i = 0; i < 6000; i += 3) {
      const glm::vec3 centre = point();
      for (int corner = 0; corner < 3; ++corner) positions_.push_back(centre + 0.1f * point());
      triangles.emplace_back(i, i + 1, i + 2);
    }
    for (int i = 0; i < kReceiverCount; ++i) receivers_.push_back({.position = point(), .normal = point()});
    ASSERT_TRUE(run_and_join_workers([&] {
      ao_.emplace(OccluderBvh({positions_, triangles}), SamplePattern::standard(64), RayOptions{.radius = GetParam()});
    }));
    for (std::size_t i = 0; i < receivers_.size(); ++i) expected_.push_back(ao_->query(receivers_[i], i));
  }

  std::optional<AmbientOcclusion> ao_;
  std::vector<glm::vec3> positions_;
  std::vector<Receiver> receivers_;
  std::vector<ReceiverOcclusion> expected_;  // by one thread, one after the other
};

INSTANTIATE_TEST_SUITE_P(Radii, DataRace, ::testing::Values(0.5f, std::numeric_limits<float>::infinity()),
                         [](const auto& radius) { return radius.param < 1 ? "Small" : "Infinite"; });

// Several times, since on a busy machine the workers may come too late for one batch.
TEST_P(DataRace, BatchAnswersAsOneThreadDoes) {
  std::uint64_t blocked_ray_count = 0;
  for (const ReceiverOcclusion& answer : expected_) {
    blocked_ray_count += static_cast<std::uint64_t>(answer.mask.count());
  }
  ASSERT_GT(blocked_ray_count, 0u);

  for (int repetition = 0; repetition < 4; ++repetition) {
    std::vector<float> occlusion(receivers_.size());
    std::vector<glm::vec3> bent_normals(receivers_.size());
    std::vector<std::uint64_t> mask_words(receivers_.size());
    QueryReport report;
    ASSERT_TRUE(run_and_join_workers([&] {
      report = ao_->query(receivers_, QueryOutputs{occlusion, bent_normals, mask_words});
    }));

    for (std::size_t i = 0; i < receivers_.size(); ++i) {
      ASSERT_EQ(mask_words[i], expected_[i].mask.words[0]) << "receiver " << i;
      ASSERT_EQ(occlusion[i], expected_[i].occlusion) << "receiver " << i;
      ASSERT_EQ(bent_normals[i], expected_[i].bent_normal) << "receiver " << i;
    }
    EXPECT_EQ(report.blocked_ray_count, blocked_ray_count);
    EXPECT_EQ(report.receiver_count, receivers_.size());
  }
}

// One by one, and in batches that each thread answers by itself.
TEST_P(DataRace, OneObjectAnswersManyThreadsAtOnce) {
  std::vector<std::size_t> mismatch_counts(kThreadCount);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < kThreadCount; ++t) {
    threads.emplace_back([this, &count = mismatch_counts[t]] {
      const AmbientOcclusion ao = *ao_;  // copies share their storage
      for (std::size_t i = 0; i < receivers_.size(); ++i) {
        if (!(ao.query(receivers_[i], i).mask == expected_[i].mask)) ++count;
      }
      std::vector<std::uint64_t> mask_words(receivers_.size());
      oneapi::tbb::task_arena alone(1);
      alone.execute([&] { ao.query(receivers_, QueryOutputs{.mask_words = mask_words}); });
      for (std::size_t i = 0; i < receivers_.size(); ++i) count += mask_words[i] != expected_[i].mask.words[0];
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(mismatch_counts, std::vector<std::size_t>(kThreadCount, 0));
}

// There and back, with triangles that rest in between, while another thread queries the hierarchy that is refitted.
TEST_P(DataRace, RefitsWhileOthersQuery) {
  std::size_t mismatch_count = 0;
  std::thread other([&] {
    for (std::size_t i = 0; i < receivers_.size(); ++i) {
      if (!(ao_->query(receivers_[i], i).mask == expected_[i].mask)) ++mismatch_count;
    }
  });
  std::vector<glm::vec3> moved = positions_;
  for (std::size_t i = 0; i < moved.size(); i += 7) moved[i].x = std::numeric_limits<float>::quiet_NaN();
  std::optional<OccluderBvh> there, back;
  ASSERT_TRUE(run_and_join_workers([&] {
    there.emplace(ao_->occluders().mesh(0).refitted(moved));
    back.emplace(there->refitted(positions_));
  }));
  other.join();
  EXPECT_EQ(mismatch_count, 0u);
  EXPECT_LT(there->report().occluder_count, back->report().occluder_count);
  const AmbientOcclusion ao(*back, ao_->pattern(), ao_->options());
  for (std::size_t i = 0; i < receivers_.size(); ++i) {
    ASSERT_EQ(ao.query(receivers_[i], i).mask, expected_[i].mask) << "receiver " << i;
  }
}

TEST(DataRaceTable, IsBuiltOnSeveralThreads) {
  const PlaneMaskTable table(SamplePattern::standard(64), {.resolution = 32, .thread_count = 4});
  EXPECT_GT(table.cell_count(), 0u);
}

TEST(DataRacePattern, StandardIsMadeOnceForAllThreads) {
  std::vector<const glm::vec3*> directions(kThreadCount);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < kThreadCount; ++t) {
    threads.emplace_back([&place = directions[t]] { place = SamplePattern::standard(192).directions().data(); });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(std::count(directions.begin(), directions.end(), directions.front()), kThreadCount);
}

}  // namespace
}  // namespace lkao
