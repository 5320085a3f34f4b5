#include "bench/report/subject.h"

#include <cstddef>
#include <string_view>

#include <fmt/format.h>

#include "bench/drawn_method.h"
#include "bench/report/own_falloff.h"

namespace lkao::bench {
namespace {

// Turns are seeds: none that a contestant has, whose rays would be among those it is compared with.
constexpr int kFirstTurn = 1000;

std::vector<float> mean_of_both(const std::vector<float>& first, const std::vector<float>& second) {
  std::vector<float> mean(first.size());
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = 0.5f * (first[i] + second[i]);
  return mean;
}

}  // namespace

Subject::Subject(const StudyScene& study_scene, float ao_radius)
    : scene(study_scene), radius(ao_radius), name(fmt::format("{} {:g}", study_scene.name, ao_radius)) {
  const std::vector<Receiver>& seen = scene.view.receivers;
  const std::string_view bytes(reinterpret_cast<const char*>(seen.data()), seen.size() * sizeof(Receiver));
  key = fmt::format("{} {}x{} {}", name, scene.view.width, scene.view.height, fingerprint(bytes));
}

const Converged& References::of(OwnFalloff falloff) {
  const auto found = known_.find(falloff);
  if (found != known_.end()) return found->second;
  const int turn_count = falloff == OwnFalloff::alchemy ? 2 * turn_count_ : turn_count_;
  const std::vector<float> first = half(falloff, kFirstTurn, turn_count);
  const std::vector<float> second = half(falloff, kFirstTurn + turn_count, turn_count);
  const scene::ReceiverImage& view = subject_.scene.view;
  return known_
      .emplace(falloff, Converged{mean_of_both(first, second), errors_of(first, second, view.width, view.height),
                                  2 * turn_count * kMaxRayCount})
      .first->second;
}

std::vector<float> References::half(OwnFalloff falloff, int first_turn, int turn_count) {
  const std::string name = fmt::format("{}, {} falloff, turns {} to {}", subject_.key,
                                       word_of(kOwnFalloffWords, falloff), first_turn, first_turn + turn_count - 1);
  const std::size_t pixel_count = subject_.scene.view.receivers.size();
  if (store_.find(name)) {
    if (const auto picture = store_.find_picture(name, pixel_count)) return *picture;
  }
  MeanPicture blocked;
  for (int turn = first_turn; turn < first_turn + turn_count; ++turn) {
    blocked.add(cast_rays(scene_.occluders.hierarchies(), subject_.scene.view.receivers, subject_.radius,
                          pattern_of(falloff, turn), turn));
  }
  const std::vector<float> picture = occlusion_of(falloff, blocked.mean());
  store_.put_picture(name, picture);
  store_.put(name, {{"rays", turn_count * kMaxRayCount}});  // last: now it counts
  return picture;
}

}  // namespace lkao::bench
