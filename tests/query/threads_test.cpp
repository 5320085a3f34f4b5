#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "lkao/lkao.h"
#include "support/meshes.h"

namespace lkao {
namespace {

struct Answers {
  std::vector<float> occlusion;
  std::vector<glm::vec3> bent_normals;
  std::vector<std::uint64_t> mask_words;
  QueryReport report;
};

Answers answer(const tests::Mesh& mesh, const std::vector<Receiver>& receivers, int thread_count) {
  // Real threads, however few cores there are.
  const tbb::global_control workers(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(thread_count));
  tbb::task_arena arena(thread_count);
  return arena.execute([&] {
    const AmbientOcclusion ao(OccluderBvh(mesh.view()), SamplePattern::standard(128), {.radius = 0.5f, .seed = 4});
    Answers answers{std::vector<float>(receivers.size()),
                    std::vector<glm::vec3>(receivers.size()),
                    std::vector<std::uint64_t>(receivers.size() * 2),
                    {}};
    answers.report = ao.query(receivers, {answers.occlusion, answers.bent_normals, answers.mask_words}, 1000);
    return answers;
  });
}

// Build and batch: the same bits for any number of threads, and as one by one.
TEST(Threads, AnyNumberGivesTheSameBits) {
  const tests::Mesh mesh = tests::random_soup(5000, 0.1f, 71);
  lut::RandomStream random(72);
  std::vector<Receiver> receivers;
  for (int i = 0; i < 1500; ++i) {
    receivers.push_back({.position = tests::random_point(random, 1), .normal = tests::random_direction(random)});
  }
  const Answers one = answer(mesh, receivers, 1);
  EXPECT_EQ(one.report.receiver_count, receivers.size());
  EXPECT_EQ(one.report.ray_count, receivers.size() * 128);
  EXPECT_GT(one.report.blocked_ray_count, 1000u);
  for (int thread_count : {2, 7}) {
    const Answers more = answer(mesh, receivers, thread_count);
    EXPECT_EQ(more.occlusion, one.occlusion) << thread_count;
    EXPECT_EQ(more.bent_normals, one.bent_normals) << thread_count;
    EXPECT_EQ(more.mask_words, one.mask_words) << thread_count;
    EXPECT_EQ(more.report.blocked_ray_count, one.report.blocked_ray_count) << thread_count;
  }
  const AmbientOcclusion ao(OccluderBvh(mesh.view()), SamplePattern::standard(128), {.radius = 0.5f, .seed = 4});
  for (std::size_t k = 0; k < receivers.size(); k += 100) {
    const ReceiverOcclusion single = ao.query(receivers[k], 1000 + k);
    EXPECT_EQ(single.occlusion, one.occlusion[k]);
    EXPECT_EQ(single.mask.words[1], one.mask_words[2 * k + 1]);
  }
}

TEST(Threads, EmptyBatchIsAnswered) { EXPECT_EQ(answer(tests::closed_box(), {}, 2).report.receiver_count, 0u); }

}  // namespace
}  // namespace lkao
