#include "lut/pattern_balance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lut/disk_relaxation.h"
#include "lut/lane_sums.h"
#include "lut/pattern_points.h"
#include "lut/random.h"

namespace lkao::lut {
namespace {

constexpr int kRoundCount = 20;
constexpr int kTurnsPerRound = 3;
// A turn moves a point by this share of the pull on it, in units of the mean distance between points; more overshoots.
constexpr float kStep = 0.04f;
// Points trade radii with one of so many next outer ones.
constexpr std::uint64_t kTradeReach = 10;
// How much farther apart heights on the hemisphere count than places on the disk: edges seen by a receiver are mostly
// level near the horizon, where floors meet walls.
constexpr double kHeightScale = 2.0;

float sum(const Lanes& lanes) {
  return ((lanes[0] + lanes[4]) + (lanes[2] + lanes[6])) + ((lanes[1] + lanes[5]) + (lanes[3] + lanes[7]));
}

struct Place {
  float x, y, z;
};

// Points in the order of their radii, which are fixed: point k lies on circle k, sqrt((k + 1/2) / count) wide on the
// disk; here, where the weighting puts it on the hemisphere.
class Balance {
 public:
  Balance(const std::vector<glm::dvec2>& points, Weighting weighting);

  void turn_all();
  void trade_all(RandomStream& random);
  std::vector<glm::dvec2> points() const;

 private:
  std::size_t count() const { return x_.size(); }
  // Point i's angle on circle k.
  Place on_circle(std::size_t i, std::size_t k) const;
  void put(std::size_t k, const Place& place) { x_[k] = place.x, y_[k] = place.y; }
  float distance(const Place& a, const Place& b) const;
  glm::vec2 pull_on(std::size_t i) const;
  float gain_of_trade(std::size_t i, std::size_t k, const Place& new_i, const Place& new_k) const;

  std::vector<float> x_, y_, z_, radii_;
  float spacing_;
};

Balance::Balance(const std::vector<glm::dvec2>& points, Weighting weighting)
    : spacing_(static_cast<float>(std::sqrt(std::numbers::pi / static_cast<double>(points.size())))) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double area = (static_cast<double>(k) + 0.5) / static_cast<double>(points.size());
    const bool is_uniform = weighting == Weighting::uniform;
    const glm::dvec2 place = is_uniform ? to_uniform(points[k]) : points[k];
    const double height = is_uniform ? 1.0 - area : std::sqrt(1.0 - area);
    x_.push_back(static_cast<float>(place.x));
    y_.push_back(static_cast<float>(place.y));
    z_.push_back(static_cast<float>(kHeightScale * height));
    radii_.push_back(static_cast<float>(is_uniform ? std::sqrt(1.0 - height * height) : std::sqrt(area)));
  }
}

// What the other points do to point i: the gradient of its distances to them on the disk.
glm::vec2 Balance::pull_on(std::size_t i) const {
  Lanes pull_x{}, pull_y{};
  for_each_in_lanes(count(), [&](std::size_t j, std::size_t lane) {
    const float dx = x_[i] - x_[j], dy = y_[i] - y_[j], dz = z_[i] - z_[j];
    const float inverse = 1.0f / std::sqrt(dx * dx + dy * dy + dz * dz + 1e-12f);
    pull_x[lane] += dx * inverse;
    pull_y[lane] += dy * inverse;
  });
  return {sum(pull_x), sum(pull_y)};
}

// One step uphill for all points at once, along their circles.
void Balance::turn_all() {
  std::vector<Place> turned(count());
  for (std::size_t i = 0; i < count(); ++i) {
    const glm::vec2 pull = pull_on(i);
    const float sideways = (pull.y * x_[i] - pull.x * y_[i]) / radii_[i];
    const float step = std::clamp(kStep * sideways, -0.5f, 0.5f) * spacing_ / radii_[i];
    const float x = x_[i] - step * y_[i], y = y_[i] + step * x_[i];
    const float back = radii_[i] / std::sqrt(x * x + y * y);
    turned[i] = {x * back, y * back, z_[i]};
  }
  for (std::size_t i = 0; i < count(); ++i) put(i, turned[i]);
}

Place Balance::on_circle(std::size_t i, std::size_t k) const {
  const float scale = radii_[k] / radii_[i];
  return {x_[i] * scale, y_[i] * scale, z_[k]};
}

float Balance::distance(const Place& a, const Place& b) const {
  const float dx = a.x - b.x, dy = a.y - b.y, dz = a.z - b.z;
  return std::sqrt(dx * dx + dy * dy + dz * dz);
}

// By how much the sum of distances grows when circle i gets the place new_i and circle k the place new_k.
float Balance::gain_of_trade(std::size_t i, std::size_t k, const Place& new_i, const Place& new_k) const {
  const Place old_i{x_[i], y_[i], z_[i]}, old_k{x_[k], y_[k], z_[k]};
  Lanes gains{};
  for_each_in_lanes(count(), [&](std::size_t j, std::size_t lane) {
    const Place other{x_[j], y_[j], z_[j]};
    gains[lane] +=
        (distance(new_i, other) - distance(old_i, other)) + (distance(new_k, other) - distance(old_k, other));
  });
  // The two themselves were among the others.
  const float with_old =
      distance(new_i, old_i) + distance(new_i, old_k) + distance(new_k, old_i) + distance(new_k, old_k);
  return sum(gains) - with_old + distance(new_i, new_k) + distance(old_i, old_k);
}

// Each point is offered the radius of one a little farther out; they trade where that spreads the points better.
void Balance::trade_all(RandomStream& random) {
  for (std::size_t i = 0; i < count(); ++i) {
    const std::size_t k = i + 1 + static_cast<std::size_t>(random.next_below(kTradeReach));
    if (k >= count()) continue;
    const Place new_i = on_circle(k, i), new_k = on_circle(i, k);
    if (gain_of_trade(i, k, new_i, new_k) > 0.0f) put(i, new_i), put(k, new_k);
  }
}

std::vector<glm::dvec2> Balance::points() const {
  std::vector<glm::dvec2> points;
  for (std::size_t k = 0; k < count(); ++k) points.emplace_back(x_[k], y_[k]);
  return points;
}

}  // namespace

void balance(std::vector<glm::dvec2>& points, std::uint64_t seed, Weighting weighting) {
  restore_equal_areas(points);
  Balance state(points, weighting);
  RandomStream random(seed);
  for (int round = 0; round < kRoundCount; ++round) {
    for (int turn = 0; turn < kTurnsPerRound; ++turn) state.turn_all();
    state.trade_all(random);
  }
  for (int turn = 0; turn < kTurnsPerRound; ++turn) state.turn_all();
  points = state.points();
  restore_equal_areas(points);  // from float rounding, and from the hemisphere
}

}  // namespace lkao::lut
