#include "aimed_patterns.h"

#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace lkao::tests {

SamplePattern pattern_of(const std::vector<PatternRay>& rays) {
  std::vector<glm::vec2> points;
  std::vector<float> lengths;
  for (const PatternRay& ray : rays) {
    const double length = glm::length(ray);
    lengths.push_back(static_cast<float>(length));
    points.emplace_back(length > 0 ? ray.x / length : 0.0, length > 0 ? ray.y / length : 0.0);
  }
  return SamplePattern::from_disk(points, lengths);
}

SamplePattern beam(int ray_count, float spread) {
  const SamplePattern& all = SamplePattern::standard(ray_count);
  std::vector<glm::vec2> points;
  for (const glm::vec2& point : all.disk()) points.push_back(spread * point);
  return SamplePattern::from_disk(points, all.lengths());
}

std::vector<PatternRay> thinned(std::vector<PatternRay> rays) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (i % 21 != 0) rays[i] = PatternRay(0);
  }
  return rays;
}

SamplePattern cross_pattern() {
  std::vector<glm::vec2> points = {{0, 0}, {0.25f, 0.25f}, {-0.5f, 0.5f}, {0.5f, -0.5f}};
  for (int i = 1; i <= 15; ++i) {
    const float x = static_cast<float>(i) / 16;
    points.insert(points.end(), {{x, 0}, {-x, 0}, {0, x}, {0, -x}});
  }
  std::vector<float> lengths;
  for (std::size_t i = 0; i < points.size(); ++i) lengths.push_back(i % 2 == 0 ? 1.0f : 0.5f);
  return SamplePattern::from_disk(points, lengths);
}

}  // namespace lkao::tests
