#include "bench/report/own_falloff.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <glm/geometric.hpp>

namespace lkao::bench {
namespace {

// As AlchemyOptions has them by default, in AO radii.
constexpr double kIntensity = 2, kEpsilon = 4e-4;

// Eq. 8 with the epsilon of Eq. 10: obscurance of a blocked direction is intensity x t / (t^2 + epsilon). That is
// largest where t^2 is epsilon, and rays have it as a share of that; what is nearer, where it would fall again, counts
// as much.
const double kNearest = std::sqrt(kEpsilon);
const double kMostObscurance = kIntensity / (2 * kNearest);

double alchemy_share(double t) { return t <= kNearest ? 1 : std::min(1.0, 2 * kNearest * t / (t * t + kEpsilon)); }

// A ball as wide as the radius, which lies on the receiver, reaches z along a direction of height z. Of ends that are
// even in it there are z^3 a direction, so heights are the fourth roots of even numbers, where those of the cosine are
// square roots; lengths are cube roots of even numbers, such as a linear falloff's are.
SamplePattern ends_in_ball() {
  const SamplePattern pattern = SamplePattern::standard(kMaxRayCount).with_falloff(Falloff::linear());
  std::vector<glm::vec2> points;
  std::vector<float> lengths;
  points.reserve(pattern.disk().size());
  lengths.reserve(pattern.disk().size());
  for (std::size_t i = 0; i < pattern.disk().size(); ++i) {
    const glm::vec2 point = pattern.disk()[i];
    const float height = std::sqrt(pattern.directions()[i].z), distance = glm::length(point);
    const float scale = distance > 0 ? std::sqrt(std::max(0.0f, 1 - height * height)) / distance : 0;
    points.push_back(scale * point);
    lengths.push_back(height * std::cbrt(pattern.lengths()[i]));
  }
  return SamplePattern::from_disk(points, lengths);
}

}  // namespace

SamplePattern pattern_of(OwnFalloff falloff, int seed) {
  const SamplePattern& standard = SamplePattern::standard(kMaxRayCount);
  switch (falloff) {
    case OwnFalloff::linear:
      return standard.with_falloff(Falloff::linear());
    case OwnFalloff::alchemy:
      return SamplePattern::make(PatternKind::sobol, kMaxRayCount, Falloff::custom("alchemy", alchemy_share),
                                 static_cast<std::uint64_t>(seed));
    case OwnFalloff::ball:
      return ends_in_ball();
    default:
      return standard;
  }
}

std::vector<float> occlusion_of(OwnFalloff falloff, std::vector<float> blocked_shares) {
  if (falloff != OwnFalloff::alchemy) return blocked_shares;
  // What is not a number stays so.
  for (float& share : blocked_shares) share = std::min(static_cast<float>(kMostObscurance) * share, 1.0f);
  return blocked_shares;
}

}  // namespace lkao::bench
