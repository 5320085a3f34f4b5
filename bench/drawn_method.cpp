#include "bench/drawn_method.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include <fmt/format.h>

#include "method/answers.h"
#include "method/list.h"

namespace lkao::bench {

std::vector<float> cast_rays(const StudyScene& scene, float radius, const Falloff& falloff, int turn_count) {
  const std::vector<OccluderLevel> occluders = {{.occluders = OccluderBvh(scene.mesh.view())}};
  const SamplePattern pattern = SamplePattern::standard(kMaxRayCount).with_falloff(falloff);
  MeanPicture picture;
  for (int turn = 0; turn < turn_count; ++turn) {
    picture.add(cast_rays(occluders, scene.view.receivers, radius, pattern, turn));
  }
  return picture.mean();
}

std::vector<float> cast_rays(const std::vector<OccluderLevel>& occluders, std::span<const Receiver> receivers,
                             float radius, const SamplePattern& pattern, int turn) {
  const RayOptions options{.radius = radius, .seed = static_cast<std::uint64_t>(turn)};
  std::vector<float> occlusion(receivers.size());
  AmbientOcclusion(occluders, pattern, options).query(receivers, {.occlusion = occlusion});
  return occlusion;
}

void MeanPicture::add(const std::vector<float>& picture) {
  sum_.resize(picture.size());
  for (std::size_t i = 0; i < sum_.size(); ++i) sum_[i] += static_cast<double>(picture[i]);
  ++count_;
}

std::vector<float> MeanPicture::mean() const {
  std::vector<float> mean(sum_.size());
  std::transform(sum_.begin(), sum_.end(), mean.begin(),
                 [this](double value) { return static_cast<float>(value / count_); });
  return mean;
}

double mean_of(const std::vector<float>& occlusion) {
  double sum = 0;
  std::size_t count = 0;
  for (const float value : occlusion) {
    if (std::isnan(value)) continue;
    sum += static_cast<double>(value);
    ++count;
  }
  return count == 0 ? 0 : sum / static_cast<double>(count);
}

double best_factor(const std::vector<float>& occlusion, const std::vector<float>& rays) {
  double product = 0, square = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (std::isnan(occlusion[i]) || std::isnan(rays[i])) continue;
    const double value = occlusion[i];
    product += value * static_cast<double>(rays[i]);
    square += value * value;
  }
  return square > 0 ? product / square : 1;
}

double scaled_rmse(const std::vector<float>& occlusion, const std::vector<float>& rays, double factor) {
  std::vector<float> scaled;
  for (const float value : occlusion) scaled.push_back(static_cast<float>(factor * static_cast<double>(value)));
  return method::deviation(scaled, rays, std::nullopt, 0).error.rmse;
}

method::Settings settings_of(std::string_view method, const ChangedSettings& changed, const method::Settings& others) {
  method::Settings settings = others;
  const std::vector<const method::Setting*>& known = method::method_named(method).settings;
  for (const auto& [name, value] : changed) {
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&name = name](const method::Setting* setting) { return setting->name == name; });
    if (found == known.end()) throw std::invalid_argument(fmt::format("{} has no setting '{}'", method, name));
    settings.set(**found, value);
  }
  return settings;
}

DrawnResult draw_method(std::string_view method, const StudyScene& scene, float radius, const Falloff& falloff,
                        const method::Settings& settings, const std::vector<float>& rays) {
  const method::Question question{.radius = radius, .ray_count = 1, .falloff = falloff};
  const std::unique_ptr<method::Method> opened = method::method_named(method).open(settings);
  method::Occluders occluders(scene.mesh);
  opened->prepare({occluders, question, method::View{scene.camera, scene.view}});
  method::Answers answers = method::ask(*opened, 1, scene.view.receivers, 1);
  DrawnResult result;
  result.milliseconds = 1000 * answers.seconds;
  result.keys = opened->remarks().keys;
  result.off = method::deviation(answers.occlusion, rays, std::nullopt, 0);
  result.occlusion = std::move(answers.occlusion);
  return result;
}

}  // namespace lkao::bench
