#include "lut/pattern_lengths.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "lut/lane_sums.h"
#include "lut/pattern_points.h"
#include "lut/random.h"

namespace lkao::lut {
namespace {

constexpr int kSweepCount = 40;
constexpr int kTradesPerPoint = 4;
// How much elevation alone counts, beside directions: a ceiling cares for nothing else, and no turn evens it out.
constexpr float kElevationWeight = 2.0f;
// Points that stand for the whole hemisphere.
constexpr int kBackgroundCount = 1024;

struct Direction {
  glm::vec3 unit;
  float share_below;  // of all directions, those lower than this one

  Direction(const glm::vec2& point, Weighting weighting)
      : unit(point, std::sqrt(std::max(0.0f, 1.0f - glm::dot(point, point)))),
        share_below(weighting == Weighting::uniform ? unit.z : unit.z * unit.z) {}
};

// How alike the occlusion of two directions is, but for a constant: less the farther they are apart.
float likeness(const Direction& a, const Direction& b) {
  return -glm::distance(a.unit, b.unit) - kElevationWeight * std::abs(a.share_below - b.share_below);
}

// A way to deal, and its error: over all regions of directions and all shares u <= v, the mean squared difference of
// the part of the rays there and the part that is due,
//   sum over i, j of likeness(i, j) (1 - max(u_i, u_j)) - sum over i of background(i) (1 - u_i^2),
// where the second sum is the same against all directions and shares there are.
class Deal {
 public:
  Deal(std::span<const glm::vec2> points, Weighting weighting);

  void shuffle(RandomStream& random);
  // Lets each point trade its share with others where the error falls.
  void trade_all(RandomStream& random);
  std::vector<int> shares() const;

 private:
  std::size_t count() const { return shares_.size(); }
  const float* row(std::size_t i) const { return likeness_.data() + i * count(); }
  float change_by_trade(std::size_t i, std::size_t k) const;

  std::vector<float> likeness_;    // of all pairs
  std::vector<float> background_;  // of each point with all directions, times the number of points
  std::vector<float> shares_;      // in (0, 1)
};

Deal::Deal(std::span<const glm::vec2> points, Weighting weighting) {
  std::vector<Direction> directions, everywhere;
  for (const glm::vec2& point : points) directions.emplace_back(point, weighting);
  for (const glm::dvec2& point : spiral_points(kBackgroundCount, 0)) {
    everywhere.emplace_back(weighting == Weighting::uniform ? to_uniform(point) : point, weighting);
  }
  for (const Direction& a : directions) {
    for (const Direction& b : directions) likeness_.push_back(likeness(a, b));
    double total = 0;
    for (const Direction& b : everywhere) total += static_cast<double>(likeness(a, b));
    background_.push_back(static_cast<float>(total / kBackgroundCount * static_cast<double>(points.size())));
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    shares_.push_back((static_cast<float>(k) + 0.5f) / static_cast<float>(points.size()));
  }
}

void Deal::shuffle(RandomStream& random) {
  for (std::size_t left = count(); left > 1; --left) std::swap(shares_[left - 1], shares_[random.next_below(left)]);
}

// Half the change of the error when points i and k trade.
float Deal::change_by_trade(std::size_t i, std::size_t k) const {
  const float u_i = shares_[i], u_k = shares_[k];
  const float* row_i = row(i);
  const float* row_k = row(k);
  Lanes lanes{};
  for_each_in_lanes(count(), [&](std::size_t j, std::size_t lane) {
    lanes[lane] += (row_i[j] - row_k[j]) * (std::max(u_i, shares_[j]) - std::max(u_k, shares_[j]));
  });
  const float with_all = std::accumulate(lanes.begin(), lanes.end(), 0.0f);
  // What the two do to each other stays.
  const float with_each_other = row_i[k] * std::abs(u_i - u_k);
  return with_all - with_each_other - 0.5f * (background_[i] - background_[k]) * (u_i * u_i - u_k * u_k);
}

void Deal::trade_all(RandomStream& random) {
  for (std::size_t i = 0; i < count(); ++i) {
    for (int trade = 0; trade < kTradesPerPoint; ++trade) {
      const std::size_t k = random.next_below(count());
      if (k != i && change_by_trade(i, k) < -1e-6f) std::swap(shares_[i], shares_[k]);
    }
  }
}

std::vector<int> Deal::shares() const {
  std::vector<int> shares;
  for (float share : shares_) shares.push_back(static_cast<int>(share * static_cast<float>(count())));
  return shares;
}

}  // namespace

std::vector<int> deal_shares(std::span<const glm::vec2> points, Weighting weighting) {
  Deal deal(points, weighting);
  RandomStream random(0);
  deal.shuffle(random);
  for (int sweep = 0; sweep < kSweepCount; ++sweep) deal.trade_all(random);
  return deal.shares();
}

}  // namespace lkao::lut
