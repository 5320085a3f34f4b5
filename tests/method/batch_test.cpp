#include "method/batch.h"

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "method/answers.h"
#include "method/list.h"
#include "scene/builtin.h"

namespace lkao::method {
namespace {

// Answers each receiver with a share of its index, and notes what it is asked.
class Pretender : public Method {
 public:
  Pretender(const Abilities& abilities, float slope) : Method(abilities), slope_(slope) {}

  void prepare(const Task&) override {}
  Answered answer(std::span<const Receiver> receivers, const QueryOutputs& outputs,
                  std::uint64_t first_index) override {
    EXPECT_EQ(first_index, answered_count);
    EXPECT_TRUE(abilities().masks || outputs.mask_words.empty());
    for (std::size_t k = 0; k < receivers.size(); ++k) {
      outputs.occlusion[k] = slope_ * static_cast<float>(first_index + k);
      if (!outputs.mask_words.empty()) outputs.mask_words[k] = slope_ > 1 ? 3 : 1;
    }
    ++call_count;
    answered_count += receivers.size();
    return {{.receiver_count = receivers.size(), .ray_count = 64 * receivers.size()}, 0.5};
  }

  int call_count = 0;
  std::size_t answered_count = 0;

 private:
  float slope_;
};

constexpr std::size_t kReceiverCount = 100'000;  // several parts
const std::vector<Receiver> kReceivers(kReceiverCount);

TEST(Batch, PartsCoverAllReceiversInOrder) {
  Pretender method({}, 2);
  const Batch batch = run_batch(method, 64, kReceivers);
  EXPECT_GT(method.call_count, 1);
  EXPECT_EQ(batch.occlusion.back(), 2 * (kReceiverCount - 1));
  EXPECT_EQ(batch.ray_count, 64 * kReceiverCount);
  EXPECT_EQ(batch.seconds, 0.5 * method.call_count);
  EXPECT_FALSE(batch.check.has_value());
}

TEST(Batch, CountsWhatIsFullyBlockedAmongValidReceivers) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Batch batch;
  EXPECT_TRUE(std::isnan(batch.fully_blocked_share()));
  batch.occlusion = {1, nan, 0.999f, 1, 0, nan};
  EXPECT_EQ(batch.fully_blocked_share(), 0.5);
  EXPECT_NEAR(batch.occlusion_mean(), 2.999 / 4, 1e-6);
}

TEST(Batch, MethodsThatDrawAnswerOnce) {
  Pretender method({}, 2), check({.any_receivers = false}, 2);
  run_batch(method, 64, kReceivers, {.check = &check});
  EXPECT_EQ(method.call_count, 1);
  EXPECT_EQ(check.call_count, 1);
}

TEST(Batch, ComparesRayByRayWhereBothTell) {
  Pretender method({}, 2), check({}, 1);
  const Batch batch = run_batch(method, 64, kReceivers, {.check = &check});
  const Deviation& off = batch.check.value().deviation;
  EXPECT_EQ(off.wrong_ray_count, kReceiverCount);
  EXPECT_EQ(off.mismatch_rate, 1.0 / 64);
  EXPECT_NEAR(off.mean_change, (kReceiverCount - 1) / 2.0, 1e-6);
  EXPECT_EQ(off.error.max_error, kReceiverCount - 1);

  Pretender again({}, 2), silent({.masks = false}, 1);
  const Batch without = run_batch(again, 64, kReceivers, {.check = &silent});
  EXPECT_FALSE(without.check.value().deviation.wrong_ray_count.has_value());
  EXPECT_TRUE(std::isnan(without.check->deviation.mismatch_rate));
  EXPECT_EQ(without.check->deviation.error.max_error, kReceiverCount - 1);
}

TEST(Batch, ProgressCanStopIt) {
  Pretender method({}, 1);
  std::size_t last_done = 0;
  const auto stop = [&](std::size_t done, std::size_t total) {
    EXPECT_EQ(total, kReceiverCount);
    last_done = done;
    return false;
  };
  EXPECT_THROW(run_batch(method, 64, kReceivers, {.progress = stop}), Cancelled);
  EXPECT_EQ(method.call_count, 1);
  EXPECT_EQ(last_done, method.answered_count);
}

// Of every method that needs no view.
TEST(Batch, MethodsAgreeOnASmallScene) {
  const scene::Mesh mesh = scene::make_builtin("sphere");
  const scene::ReceiverImage image = scene::find_receivers(mesh, scene::builtin_scene("sphere").camera, 32, 24);
  Occluders occluders(mesh);
  EXPECT_EQ(occluders.build_seconds(), 0);
  const Question question{.radius = 0.7f, .ray_count = 64};
  const AmbientOcclusion query(OccluderBvh(mesh.view()), question.pattern(), question.ray_options());
  const Answers right = ask(query, image.receivers, 1);
  EXPECT_GT(right.ray_count, 0u);
  for (const MethodKind& kind : method_kinds()) {
    if (!kind.is_built() || !kind.abilities({}).any_receivers) continue;
    const std::unique_ptr<Method> method = kind.open({});
    method->prepare({occluders, question});
    const Answers answers = ask(*method, question.pattern().word_count(), image.receivers, 2);
    EXPECT_LE(deviation(answers, right).wrong_ray_count.value(), 2u) << kind.word;
    EXPECT_EQ(answers.ray_count, right.ray_count) << kind.word;
    EXPECT_GT(answers.seconds, 0) << kind.word;
  }
  EXPECT_GT(occluders.build_seconds(), 0);
}

}  // namespace
}  // namespace lkao::method
