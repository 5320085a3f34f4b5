// A method that draws the pixels of a view, against many rays.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/study_scenes.h"
#include "lkao/ambient_occlusion.h"
#include "lkao/sample_pattern.h"
#include "method/deviation.h"
#include "method/method.h"

namespace lkao::bench {

// What every pixel of the view should be: `turn_count` times 1024 rays, by the query; other turns are other rays. NaN
// where there is no receiver.
std::vector<float> cast_rays(const StudyScene& scene, float radius, const Falloff& falloff, int turn_count);
// One turn, of any pattern, among hierarchies that are there already.
std::vector<float> cast_rays(const std::vector<OccluderLevel>& occluders, std::span<const Receiver> receivers,
                             float radius, const SamplePattern& pattern, int turn);

// The mean of pictures of one size, which come one by one.
class MeanPicture {
 public:
  void add(const std::vector<float>& picture);
  std::vector<float> mean() const;

 private:
  std::vector<double> sum_;
  int count_ = 0;
};

// Of pixels with a receiver.
double mean_of(const std::vector<float>& occlusion);
// The factor of the occlusion that brings it nearest to the rays, by least squares, and its RMSE then: what an artist's
// choice of an intensity could mend.
double best_factor(const std::vector<float>& occlusion, const std::vector<float>& rays);
double scaled_rmse(const std::vector<float>& occlusion, const std::vector<float>& rays, double factor);

// Settings of a method that are not at their defaults: names and values.
using ChangedSettings = std::vector<std::pair<std::string, std::string>>;
// Throws std::invalid_argument where there is no such setting or value.
method::Settings settings_of(std::string_view method, const ChangedSettings& changed, const method::Settings& others);

struct DrawnResult {
  std::vector<float> occlusion;
  double milliseconds = 0;
  nlohmann::ordered_json keys;  // method::Remarks
  method::Deviation off;        // from the rays
};
DrawnResult draw_method(std::string_view method, const StudyScene& scene, float radius, const Falloff& falloff,
                        const method::Settings& settings, const std::vector<float>& rays);

}  // namespace lkao::bench
