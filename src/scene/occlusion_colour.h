// Occlusion as a colour of vertices and faces.
#pragma once

#include <algorithm>
#include <cmath>

namespace lkao::scene {

enum class ColourCoding {
  srgb,  // as screens show it, and as programs take colours of vertices unless told otherwise
  linear,
};

// The grey of the visibility 1 - occlusion, in [0, 1]; black where there is none (NaN).
inline double grey_of(float occlusion, ColourCoding coding) {
  const float visibility = 1.0f - occlusion;
  if (!(visibility > 0)) return 0;
  const double linear = std::min(static_cast<double>(visibility), 1.0);
  if (coding == ColourCoding::linear) return linear;
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

}  // namespace lkao::scene
