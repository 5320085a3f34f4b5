#include "lut/disk_relaxation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "lut/random.h"

namespace lkao::lut {
namespace {

// Grid samples a Voronoi cell: centroids are then good to about 1 % of a cell.
constexpr int kSamplesPerCell = 64;

// The unit disk as the centres of small squares, which stand for its area.
std::vector<glm::dvec2> area_samples(int point_count) {
  const int side = static_cast<int>(std::ceil(std::sqrt(kSamplesPerCell * point_count * 4.0 / std::numbers::pi)));
  std::vector<glm::dvec2> samples;
  samples.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const glm::dvec2 sample((x + 0.5) * 2.0 / side - 1.0, (y + 0.5) * 2.0 / side - 1.0);
      if (glm::dot(sample, sample) <= 1.0) samples.push_back(sample);
    }
  }
  return samples;
}

// Finds the nearest of a set of points through a grid of buckets over [-1, 1]^2.
class NearestPoint {
 public:
  explicit NearestPoint(const std::vector<glm::dvec2>& points) : points_(points) {
    side_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(points.size()))));
    buckets_.resize(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_));
    for (std::size_t i = 0; i < points.size(); ++i) bucket(cell(points[i].x), cell(points[i].y)).push_back(i);
  }

  std::size_t operator()(const glm::dvec2& query) const {
    std::size_t best = 0;
    double best_distance2 = 1e30;
    const int center_x = cell(query.x), center_y = cell(query.y);
    // Rings of buckets outwards; a ring farther than the best point so far cannot hold a nearer one.
    for (int ring = 0; ring <= side_; ++ring) {
      const double ring_distance = (ring - 1) * 2.0 / side_;
      if (ring > 0 && ring_distance > 0 && ring_distance * ring_distance > best_distance2) break;
      for (int y = std::max(0, center_y - ring); y <= std::min(side_ - 1, center_y + ring); ++y) {
        const bool whole_row = std::abs(y - center_y) == ring;
        for (int x = center_x - ring; x <= center_x + ring; x += whole_row ? 1 : std::max(1, 2 * ring)) {
          if (x < 0 || x >= side_) continue;
          for (std::size_t i : bucket(x, y)) {
            const glm::dvec2 offset = points_[i] - query;
            const double distance2 = glm::dot(offset, offset);
            if (distance2 < best_distance2) best_distance2 = distance2, best = i;
          }
        }
      }
    }
    return best;
  }

 private:
  int cell(double v) const { return std::clamp(static_cast<int>((v + 1.0) * 0.5 * side_), 0, side_ - 1); }
  std::vector<std::size_t>& bucket(int x, int y) { return buckets_[static_cast<std::size_t>(y * side_ + x)]; }
  const std::vector<std::size_t>& bucket(int x, int y) const {
    return buckets_[static_cast<std::size_t>(y * side_ + x)];
  }

  const std::vector<glm::dvec2>& points_;
  int side_;
  std::vector<std::vector<std::size_t>> buckets_;
};

// The samples of each point's Voronoi cell.
std::vector<std::vector<std::size_t>> voronoi_cells(const std::vector<glm::dvec2>& points,
                                                    const std::vector<glm::dvec2>& samples) {
  const NearestPoint nearest(points);
  std::vector<std::vector<std::size_t>> cells(points.size());
  for (std::size_t s = 0; s < samples.size(); ++s) cells[nearest(samples[s])].push_back(s);
  return cells;
}

}  // namespace

void relax(std::vector<glm::dvec2>& points, int step_count) {
  const std::vector<glm::dvec2> samples = area_samples(static_cast<int>(points.size()));
  std::vector<glm::dvec2> sums(points.size());
  std::vector<int> counts(points.size());
  for (int step = 0; step < step_count; ++step) {
    std::fill(sums.begin(), sums.end(), glm::dvec2(0));
    std::fill(counts.begin(), counts.end(), 0);
    const NearestPoint nearest(points);
    for (const glm::dvec2& sample : samples) {
      const std::size_t i = nearest(sample);
      sums[i] += sample;
      ++counts[i];
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (counts[i] > 0) points[i] = sums[i] / static_cast<double>(counts[i]);
    }
  }
}

void scatter(std::vector<glm::dvec2>& points, double share, std::uint64_t seed) {
  const std::vector<glm::dvec2> samples = area_samples(static_cast<int>(points.size()));
  const std::vector<std::vector<std::size_t>> cells = voronoi_cells(points, samples);
  RandomStream random(seed);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (cells[i].empty()) continue;
    const glm::dvec2& place = samples[cells[i][random.next_below(cells[i].size())]];
    points[i] += share * (place - points[i]);
  }
}

void restore_equal_areas(std::vector<glm::dvec2>& points) {
  std::stable_sort(points.begin(), points.end(),
                   [](const glm::dvec2& a, const glm::dvec2& b) { return glm::dot(a, a) < glm::dot(b, b); });
  for (std::size_t rank = 0; rank < points.size(); ++rank) {
    const double radius = std::sqrt((static_cast<double>(rank) + 0.5) / static_cast<double>(points.size()));
    const double length = glm::length(points[rank]);
    points[rank] = length > 0 ? points[rank] * (radius / length) : glm::dvec2(radius, 0);
  }
}

}  // namespace lkao::lut
