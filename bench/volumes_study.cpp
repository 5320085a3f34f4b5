#include "bench/volumes_study.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "method/answers.h"
#include "method/list.h"

namespace lkao::bench {
namespace {

// log-dagger of Eq. 14.
double signed_log(double x) { return std::copysign(std::log(std::fabs(x) + 1), x); }

double square(double x) { return x * x; }

class Mean {
 public:
  // Nothing where the value is none.
  void add(double value) {
    if (std::isnan(value)) return;
    sum_ += value;
    ++count_;
  }
  double value() const { return count_ == 0 ? 0 : sum_ / static_cast<double>(count_); }

 private:
  double sum_ = 0;
  std::size_t count_ = 0;
};

}  // namespace

std::vector<float> cast_linear_rays(const StudyScene& scene, float radius, int turn_count) {
  const OccluderBvh bvh({scene.mesh.positions, scene.mesh.triangles});
  const SamplePattern pattern = SamplePattern::standard(kMaxRayCount).with_falloff(Falloff::linear());
  std::vector<float> occlusion(scene.view.receivers.size());
  std::vector<double> sum(occlusion.size());
  for (int turn = 0; turn < turn_count; ++turn) {
    const RayOptions options{.radius = radius, .seed = static_cast<std::uint64_t>(turn)};
    AmbientOcclusion(bvh, pattern, options).query(scene.view.receivers, {.occlusion = occlusion});
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += static_cast<double>(occlusion[i]);
  }
  std::transform(sum.begin(), sum.end(), occlusion.begin(),
                 [turn_count](double value) { return static_cast<float>(value / turn_count); });
  return occlusion;
}

method::Settings settings_of(const VolumeSettings& changed, const method::Settings& others) {
  method::Settings settings = others;
  const std::vector<const method::Setting*>& known = method::method_named("volumes").settings;
  for (const auto& [name, value] : changed) {
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&name = name](const method::Setting* setting) { return setting->name == name; });
    if (found == known.end()) throw std::invalid_argument(fmt::format("volumes have no setting '{}'", name));
    settings.set(**found, value);
  }
  return settings;
}

VolumesResult draw_volumes(const StudyScene& scene, float radius, const method::Settings& settings,
                           const std::vector<float>& rays) {
  const method::Question question{.radius = radius, .ray_count = 1, .falloff = Falloff::linear()};
  const std::unique_ptr<method::Method> volumes = method::method_named("volumes").open(settings);
  method::Occluders occluders(scene.mesh);
  volumes->prepare({occluders, question, method::View{scene.camera, scene.view}});
  method::Answers answers = method::ask(*volumes, 1, scene.view.receivers, 1);
  const nlohmann::ordered_json counts = volumes->remarks().keys.at("volumes");
  const auto receiver_count = static_cast<double>(scene.receivers.size());
  const auto a_receiver = [&](const char* key) { return counts.at(key).get<double>() / receiver_count; };
  VolumesResult result;
  result.milliseconds = 1000 * answers.seconds;
  result.fill = a_receiver("fragments");
  result.inside = a_receiver("fragments_inside");
  result.blended = a_receiver("fragments_blended");
  result.off = method::deviation(answers.occlusion, rays, std::nullopt, 0);
  result.log_error = log_error(answers.occlusion, rays, scene.view.width, scene.view.height);
  result.occlusion = std::move(answers.occlusion);
  return result;
}

double log_error(const std::vector<float>& occlusion, const std::vector<float>& right, int width, int height) {
  const auto accessibility = [](const std::vector<float>& picture, std::size_t i) {
    return 255 * (1 - static_cast<double>(picture[i]));
  };
  Mean values, along_x, along_y;
  // Of the pixel to the right, or the one below.
  const auto add_difference = [&](Mean& mean, std::size_t i, std::size_t next) {
    const double drawn = accessibility(occlusion, next) - accessibility(occlusion, i);
    const double cast = accessibility(right, next) - accessibility(right, i);
    mean.add(square(signed_log(drawn) - signed_log(cast)));
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      values.add(square(signed_log(accessibility(occlusion, i)) - signed_log(accessibility(right, i))));
      if (x + 1 < width) add_difference(along_x, i, i + 1);
      if (y + 1 < height) add_difference(along_y, i, i + static_cast<std::size_t>(width));
    }
  }
  return values.value() + 0.5 * (along_x.value() + along_y.value());
}

void CompensationFit::add(const std::vector<float>& occlusion, const std::vector<float>& right) {
  const double weight = 1 / static_cast<double>(occlusion.size());
  for (std::size_t i = 0; i < occlusion.size(); ++i) {
    if (std::isnan(occlusion[i]) || std::isnan(right[i])) continue;
    const auto o = static_cast<double>(occlusion[i]);
    const double powers[3] = {o, o * o, o * o * o};
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) products_[row][column] += weight * powers[row] * powers[column];
      right_[row] += weight * powers[row] * static_cast<double>(right[i]);
    }
  }
}

glm::dvec3 CompensationFit::curve() const {
  glm::dmat3 products;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) products[column][row] = products_[row][column];
  }
  return glm::inverse(products) * glm::dvec3(right_[0], right_[1], right_[2]);
}

}  // namespace lkao::bench
