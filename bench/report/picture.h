// Pictures as the page holds them: as small as they can be and still be read pixel by pixel.
//
// Values are steps of 1 / `steps`: the number of rays where that is what they are multiples of; else 1000, which is as
// near as many rays are known; or 250 where the error is at least ten of these. What is told is how far a picture is
// from the rays, which is little of good methods
// (`coding` "plain"), or by how much that differs from what the pixels to the left and above let expect (the median of
// both and of their plane, as LOCO-I has it: M. Weinberger et al., 2000), which is little where errors are smooth
// ("smooth"). In two bytes a pixel, all low ones first; 65535: no receiver. Deflated, in base 64.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace lkao::bench {

class PictureEncoder {
 public:
  // Of occlusion by many rays, row by row, NaN where there is no receiver; it becomes the picture "rays".
  PictureEncoder(const std::vector<float>& rays, int width);

  // Of the same size. Throws std::runtime_error where memory ends.
  void add(const std::string& name, const std::vector<float>& occlusion);
  // Of small whole numbers.
  void add_counts(const std::string& name, const std::vector<float>& counts);

  // {NAME: {steps, coding, data}}, or {as: NAME} where that one is the same.
  nlohmann::ordered_json take() { return std::move(pictures_); }

 private:
  void put(const std::string& name, const std::vector<float>& values, int steps, bool has_base);

  std::vector<float> rays_;  // as the page reads them
  int width_;
  std::map<std::string, std::string> known_;  // names by what they are
  nlohmann::ordered_json pictures_;
};

}  // namespace lkao::bench
