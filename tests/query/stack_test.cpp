// Queries keep to the stack that ambient_occlusion.h grants them.
#include <pthread.h>

#include <cstddef>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "lkao/lkao.h"
#include "support/meshes.h"
#include "support/receivers.h"

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define LKAO_STACK_HAS_RED_ZONES 1
#endif
#endif

namespace lkao {
namespace {

// For the 12 levels of a hierarchy; those below have 7.
constexpr std::size_t kGranted = (120 + 12 * 5 / 2) << 10;
// For the thread itself: its own data, and what runs below the query.
constexpr std::size_t kOfTheThread = 32 << 10;

struct Task {
  const AmbientOcclusion* ao;
  const std::vector<Receiver>* receivers;
  std::size_t blocked_count = 0;
};

void* run(void* argument) {
  Task& task = *static_cast<Task*>(argument);
  for (std::size_t i = 0; i < task.receivers->size(); ++i) {
    task.blocked_count += static_cast<std::size_t>(task.ao->query((*task.receivers)[i], i).mask.count());
  }
  return nullptr;
}

TEST(Stack, QueriesNeedNoMoreThanIsSaid) {
#ifdef LKAO_STACK_HAS_RED_ZONES
  GTEST_SKIP() << "the address sanitizer needs more stack";
#endif
  const tests::Mesh mesh = tests::random_soup(20000, 0.1f, 11);
  const OccluderBvh occluders(mesh.view());
  const std::vector<Receiver> receivers = tests::random_receivers(200, 1, 12);
  pthread_attr_t attributes;
  ASSERT_EQ(pthread_attr_init(&attributes), 0);
  ASSERT_EQ(pthread_attr_setstacksize(&attributes, kGranted + kOfTheThread), 0);
  constexpr float kEndless = std::numeric_limits<float>::infinity();
  for (const RayOptions& options : {RayOptions{.radius = 0.3f}, RayOptions{.radius = kEndless},
                                    RayOptions{.radius = kEndless, .min_distance = 0.01f}}) {
    const AmbientOcclusion ao(occluders, SamplePattern::standard(1024), options);
    Task task{&ao, &receivers};
    pthread_t thread;
    ASSERT_EQ(pthread_create(&thread, &attributes, run, &task), 0);
    ASSERT_EQ(pthread_join(thread, nullptr), 0);
    EXPECT_GT(task.blocked_count, 10000u);
  }
  pthread_attr_destroy(&attributes);
}

}  // namespace
}  // namespace lkao
