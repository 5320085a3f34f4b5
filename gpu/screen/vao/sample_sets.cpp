// Based on: J. Boksansky, A. Pospisil, J. Bittner, "VAO++: Practical Volumetric Ambient Occlusion for Games",
// EGSR 2017, Sec. 4.5.
// Differs from the paper:
// - The spacing is the largest of a falling row for which random darts fill the set; how the paper finds its own is not
//   said.
// - Places keep a third of the spacing from the edge. Without this, sets of few places lie mostly on the edge, where
//   pipes are short (mean pipe of 4 places: 0.51; of all places of the disc, and nearly of these sets: 2/3).
// - How single places are turned is found by climbing from many starts and for all places at once. The paper tries all
//   ways, for eight places at a time, which takes seconds. Of sets up to 8 both find the same (tested).
#include "gpu/screen/vao/sample_sets.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <glm/geometric.hpp>

#include "lut/random.h"

namespace lkao::gl {
namespace {

constexpr double kNinth = 2 * std::numbers::pi / kSampleRotationCount;
constexpr double kEdgeShare = 1.0 / 3;

// With all its rotations; `turn` in [0, kNinth).
struct Dart {
  double radius, turn;
};

// From one to the nearest rotation of the other.
double distance_of(const Dart& a, const Dart& b) {
  const double apart = std::fabs(a.turn - b.turn), angle = std::min(apart, kNinth - apart);
  return std::sqrt(a.radius * a.radius + b.radius * b.radius - 2 * a.radius * b.radius * std::cos(angle));
}

double distance_of_rotations(const Dart& a) { return 2 * a.radius * std::sin(kNinth / 2); }

// As many as are wanted, or fewer where many darts in turn find no room.
std::vector<Dart> throw_darts(int count, double spacing, lut::RandomStream& random) {
  constexpr int kTryCount = 1000;
  std::vector<Dart> darts;
  for (int i = 0; i < kTryCount && std::ssize(darts) < count; ++i) {
    const double share = random.next_double(), turn = kNinth * random.next_double();
    const Dart dart{(1 - kEdgeShare * spacing) * std::sqrt(share), turn};
    const bool has_room =
        distance_of_rotations(dart) >= spacing &&
        std::all_of(darts.begin(), darts.end(), [&](const Dart& d) { return distance_of(d, dart) >= spacing; });
    if (has_room) darts.push_back(dart);
  }
  return darts;
}

glm::dvec2 turned(const Dart& dart, int ninths) {
  const double angle = dart.turn + ninths * kNinth;
  return dart.radius * glm::dvec2(std::cos(angle), std::sin(angle));
}

// Turns one place after the other to where its distances to all others add up to most, until none moves.
void climb(const std::vector<Dart>& darts, std::vector<glm::dvec2>& places) {
  bool has_moved = true;
  while (has_moved) {
    has_moved = false;
    for (std::size_t i = 0; i < darts.size(); ++i) {
      const auto sum_at = [&](const glm::dvec2& place) {
        double sum = 0;
        for (std::size_t k = 0; k < places.size(); ++k) sum += k != i ? glm::distance(places[k], place) : 0;
        return sum;
      };
      double best = sum_at(places[i]);
      for (int ninths = 0; ninths < kSampleRotationCount; ++ninths) {
        const glm::dvec2 place = turned(darts[i], ninths);
        if (const double sum = sum_at(place); sum > best + 1e-9) {
          best = sum;
          places[i] = place;
          has_moved = true;
        }
      }
    }
  }
}

double sum_of_distances(const std::vector<glm::dvec2>& places) {
  double sum = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) sum += glm::distance(places[i], places[k]);
  }
  return sum;
}

std::vector<glm::dvec2> spread(const std::vector<Dart>& darts, lut::RandomStream& random) {
  const auto start_count = 3200 / darts.size();
  std::vector<glm::dvec2> best;
  for (std::size_t start = 0; start < start_count; ++start) {
    std::vector<glm::dvec2> places;
    places.reserve(darts.size());
    for (const Dart& dart : darts) places.push_back(turned(dart, static_cast<int>(random.next_below(9))));
    climb(darts, places);
    if (best.empty() || sum_of_distances(places) > sum_of_distances(best)) best = places;
  }
  return best;
}

// G. M. Morton's order: the bits of both coordinates in turn.
std::uint32_t z_order(const glm::dvec2& place) {
  const auto x = static_cast<std::uint32_t>((place.x + 1) * 32767.5),
             y = static_cast<std::uint32_t>((place.y + 1) * 32767.5);
  std::uint32_t code = 0;
  for (unsigned bit = 0; bit < 16; ++bit) code |= (x >> bit & 1u) << 2 * bit | (y >> bit & 1u) << (2 * bit + 1);
  return code;
}

}  // namespace

SampleSet make_sample_set(int count, std::uint64_t seed) {
  lut::RandomStream random(seed);
  // Of the hexagonal lattice with as many places, all rotations counted: no set is as far apart.
  const double hexagonal = std::sqrt(2 * std::numbers::pi / (std::numbers::sqrt3 * kSampleRotationCount * count));
  double spacing = hexagonal;
  std::vector<Dart> darts;
  for (; std::ssize(darts) < count; spacing *= 0.98) darts = throw_darts(count, spacing, random);
  SampleSet set{spread(darts, random), spacing / 0.98};
  std::sort(set.places.begin(), set.places.end(),
            [](const glm::dvec2& a, const glm::dvec2& b) { return z_order(a) < z_order(b); });
  return set;
}

const std::array<glm::vec2, kSampleSetTotal>& sample_sets() {
  static const auto sets = [] {
    std::array<glm::vec2, kSampleSetTotal> all{};
    auto next = all.begin();
    for (const int size : kSampleSetSizes) {
      const SampleSet set = make_sample_set(size);
      next = std::copy(set.places.begin(), set.places.end(), next);
    }
    return all;
  }();
  return sets;
}

}  // namespace lkao::gl
