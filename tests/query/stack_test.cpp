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

// For the 12 levels of a hierarchy; those below have 7, and 3 over the instances.
constexpr std::size_t kGranted = (120 + 12 * 5 / 2) << 10, kGrantedWithInstances = kGranted + (60 << 10);
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

// Blocked rays of all receivers, in a thread that has so much stack.
std::size_t count_blocked(const AmbientOcclusion& ao, const std::vector<Receiver>& receivers, std::size_t stack) {
  pthread_attr_t attributes;
  EXPECT_EQ(pthread_attr_init(&attributes), 0);
  EXPECT_EQ(pthread_attr_setstacksize(&attributes, stack + kOfTheThread), 0);
  Task task{&ao, &receivers};
  pthread_t thread;
  if (pthread_create(&thread, &attributes, run, &task) != 0 || pthread_join(thread, nullptr) != 0) ADD_FAILURE();
  pthread_attr_destroy(&attributes);
  return task.blocked_count;
}

// A cloud of triangles, many times.
OccluderScene scene_of_clouds(const OccluderBvh& cloud) {
  std::vector<OccluderInstance> instances(300);
  for (std::size_t k = 0; k < instances.size(); ++k) {
    const auto step = 0.002f * static_cast<float>(k);
    instances[k].to_world = glm::mat4x3({1, step, 0}, {0, 1, step}, {step, 0, 1}, glm::vec3(step));
  }
  return {{cloud}, instances};
}

TEST(Stack, QueriesNeedNoMoreThanIsSaid) {
#ifdef LKAO_STACK_HAS_RED_ZONES
  GTEST_SKIP() << "the address sanitizer needs more stack";
#endif
  const OccluderBvh cloud(tests::random_soup(20000, 0.1f, 11).view());
  const OccluderScene clouds = scene_of_clouds(OccluderBvh(tests::random_soup(2000, 0.1f, 11).view()));
  const std::vector<Receiver> receivers = tests::random_receivers(200, 1, 12);
  constexpr float kEndless = std::numeric_limits<float>::infinity();
  for (const RayOptions& options : {RayOptions{.radius = 0.3f}, RayOptions{.radius = kEndless},
                                    RayOptions{.radius = kEndless, .min_distance = 0.01f}}) {
    const SamplePattern pattern = SamplePattern::standard(1024);
    EXPECT_GT(count_blocked({cloud, pattern, options}, receivers, kGranted), 10000u);
    EXPECT_GT(count_blocked({clouds, pattern, options}, receivers, kGrantedWithInstances), 10000u);
  }
}

}  // namespace
}  // namespace lkao
