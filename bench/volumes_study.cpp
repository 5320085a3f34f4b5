#include "bench/volumes_study.h"

#include <cmath>
#include <cstddef>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

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

VolumesResult draw_volumes(const StudyScene& scene, float radius, const method::Settings& settings,
                           const std::vector<float>& rays) {
  VolumesResult result{draw_method("volumes", scene, radius, Falloff::linear(), settings, rays)};
  const auto receiver_count = static_cast<double>(scene.receivers.size());
  const nlohmann::ordered_json& counts = result.keys.at("volumes");
  const auto a_receiver = [&](const char* key) { return counts.at(key).get<double>() / receiver_count; };
  result.fill = a_receiver("fragments");
  result.inside = a_receiver("fragments_inside");
  result.blended = a_receiver("fragments_blended");
  result.log_error = log_error(result.occlusion, rays, scene.view.width, scene.view.height);
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
