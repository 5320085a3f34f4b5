#include "bench/report/subject.h"

#include <cstddef>
#include <string_view>

#include <fmt/format.h>

#include "bench/drawn_method.h"

namespace lkao::bench {
namespace {

// Turns are seeds: none that a contestant has, whose rays would be among those it is compared with.
constexpr int kFirstTurn = 1000;

std::vector<float> mean_of_both(const std::vector<float>& first, const std::vector<float>& second) {
  std::vector<float> mean(first.size());
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = 0.5f * (first[i] + second[i]);
  return mean;
}

std::vector<float> half(const Subject& subject, const Falloff& falloff, int first_turn, int turn_count,
                        const ReportStore& store) {
  const std::string name = fmt::format("{}, {} falloff, turns {} to {}", subject.key, falloff.name(), first_turn,
                                       first_turn + turn_count - 1);
  const std::size_t pixel_count = subject.scene.view.receivers.size();
  if (store.find(name)) {
    if (const auto picture = store.find_picture(name, pixel_count)) return *picture;
  }
  std::vector<float> picture = cast_rays(subject.scene, subject.radius, falloff, turn_count, first_turn);
  store.put_picture(name, picture);
  store.put(name, {{"rays", turn_count * kMaxRayCount}});  // last: now it counts
  return picture;
}

}  // namespace

Subject::Subject(const StudyScene& study_scene, float ao_radius)
    : scene(study_scene), radius(ao_radius), name(fmt::format("{} {:g}", study_scene.name, ao_radius)) {
  const std::vector<Receiver>& seen = scene.view.receivers;
  const std::string_view bytes(reinterpret_cast<const char*>(seen.data()), seen.size() * sizeof(Receiver));
  key = fmt::format("{} {}x{} {}", name, scene.view.width, scene.view.height, fingerprint(bytes));
}

Converged converge(const Subject& subject, const Falloff& falloff, int turn_count, const ReportStore& store) {
  const std::vector<float> first = half(subject, falloff, kFirstTurn, turn_count, store);
  const std::vector<float> second = half(subject, falloff, kFirstTurn + turn_count, turn_count, store);
  const scene::ReceiverImage& view = subject.scene.view;
  return {mean_of_both(first, second), errors_of(first, second, view.width, view.height),
          2 * turn_count * kMaxRayCount};
}

}  // namespace lkao::bench
