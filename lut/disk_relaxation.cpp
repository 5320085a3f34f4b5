#include "lut/disk_relaxation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <glm/geometric.hpp>

#include "lut/random.h"

namespace lkao::lut {
namespace {

// Laine & Karras 2010, Sec. 6, name "a large number" and "a few" steps.
constexpr int kFirstStepCount = 60;
constexpr int kSecondStepCount = 3;
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

// One Lloyd step: every point goes to the centroid of its Voronoi cell.
void relax(std::vector<glm::dvec2>& points, const std::vector<glm::dvec2>& samples) {
  const NearestPoint nearest(points);
  std::vector<glm::dvec2> sums(points.size(), glm::dvec2(0));
  std::vector<int> counts(points.size(), 0);
  for (const glm::dvec2& sample : samples) {
    const std::size_t i = nearest(sample);
    sums[i] += sample;
    ++counts[i];
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (counts[i] > 0) points[i] = sums[i] / static_cast<double>(counts[i]);
  }
}

// Every point goes to a random place of its Voronoi cell ("reintroduce randomness", Sec. 6).
void scatter(std::vector<glm::dvec2>& points, const std::vector<glm::dvec2>& samples, RandomStream& random) {
  const NearestPoint nearest(points);
  std::vector<std::vector<std::size_t>> cells(points.size());
  for (std::size_t s = 0; s < samples.size(); ++s) cells[nearest(samples[s])].push_back(s);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!cells[i].empty()) points[i] = samples[cells[i][random.next_below(cells[i].size())]];
  }
}

}  // namespace

std::vector<glm::dvec2> spiral_points(int point_count, std::uint64_t seed) {
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double turn = RandomStream(seed).next_double() * 2.0 * std::numbers::pi;
  std::vector<glm::dvec2> points;
  for (int i = 0; i < point_count; ++i) {
    const double radius = std::sqrt((i + 0.5) / point_count);
    const double angle = turn + i * golden_angle;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return points;
}

std::vector<glm::dvec2> relaxed_points(int point_count, std::uint64_t seed) {
  std::vector<glm::dvec2> points = spiral_points(point_count, seed);
  const std::vector<glm::dvec2> samples = area_samples(point_count);
  RandomStream random(seed ^ 0x5ca77e2u);
  for (int step = 0; step < kFirstStepCount; ++step) relax(points, samples);
  scatter(points, samples, random);
  for (int step = 0; step < kSecondStepCount; ++step) relax(points, samples);
  restore_equal_areas(points);
  return points;
}

void restore_equal_areas(std::vector<glm::dvec2>& points) {
  std::vector<std::size_t> by_radius(points.size());
  std::iota(by_radius.begin(), by_radius.end(), std::size_t{0});
  std::sort(by_radius.begin(), by_radius.end(), [&](std::size_t a, std::size_t b) {
    const double radius_a = glm::dot(points[a], points[a]), radius_b = glm::dot(points[b], points[b]);
    return radius_a != radius_b ? radius_a < radius_b : a < b;
  });
  for (std::size_t rank = 0; rank < by_radius.size(); ++rank) {
    glm::dvec2& point = points[by_radius[rank]];
    const double radius = std::sqrt((static_cast<double>(rank) + 0.5) / static_cast<double>(points.size()));
    const double length = glm::length(point);
    point = length > 0 ? point * (radius / length) : glm::dvec2(radius, 0);
  }
}

}  // namespace lkao::lut
