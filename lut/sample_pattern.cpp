#include "lkao/sample_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "lut/hilbert.h"
#include "lut/pattern_lengths.h"
#include "lut/pattern_points.h"
#include "lut/pattern_recipes.h"

namespace lkao {

struct SamplePattern::Directions {
  std::vector<glm::vec2> disk;
  std::vector<glm::vec3> directions;
  float lowest_elevation = 0;
  Weighting weighting = Weighting::cosine;

  // The share of each ray, found when first asked for, from any thread.
  const std::vector<int>& shares() const {
    std::call_once(once_, [this] { shares_ = lut::deal_shares(disk, weighting); });
    return shares_;
  }

 private:
  mutable std::once_flag once_;
  mutable std::vector<int> shares_;
};

namespace {

constexpr std::pair<PatternKind, std::string_view> kKindNames[] = {{PatternKind::lloyd, "lloyd"},
                                                                   {PatternKind::paper, "paper"},
                                                                   {PatternKind::fibonacci, "fibonacci"},
                                                                   {PatternKind::sobol, "sobol"},
                                                                   {PatternKind::random, "random"}};

void require_valid_ray_count(std::int64_t ray_count) {
  if (ray_count < kMinRayCount || ray_count > kMaxRayCount) {
    throw std::invalid_argument(
        fmt::format("ray count must be from {} to {}, not {}", kMinRayCount, kMaxRayCount, ray_count));
  }
}

void require_known(Weighting weighting) {
  if (weighting == Weighting::cosine || weighting == Weighting::uniform) return;
  throw std::invalid_argument(fmt::format("weighting {} does not exist", static_cast<int>(weighting)));
}

// Points spread evenly over the disk become cosine-weighted directions (Laine & Karras 2010, Sec. 6).
glm::vec3 lift(const glm::vec2& point) {
  const double x = point.x, y = point.y;
  return {point.x, point.y, static_cast<float>(std::sqrt(1.0 - x * x - y * y))};
}

// Independent points come as near to the edge of the disk as rounding allows; every direction must have z > 0.
glm::vec2 inside_disk(const glm::dvec2& point) {
  constexpr double kLargestRadius = 1.0 - 0x1p-20;
  const double radius = glm::length(point);
  return radius > kLargestRadius ? point * (kLargestRadius / radius) : point;
}

// Lengths with P(length >= x) = rho(x) (Eq. 3): one in each of ray_count equal shares of rho, longest first.
std::vector<float> stratified_lengths(std::size_t ray_count, const Falloff& falloff) {
  std::vector<float> lengths;
  for (std::size_t k = 0; k < ray_count; ++k) {
    const double share = (static_cast<double>(k) + 0.5) / static_cast<double>(ray_count);
    lengths.push_back(static_cast<float>(falloff.length_at(share)));
  }
  return lengths;
}

}  // namespace

PatternKind pattern_kind_named(const std::string& name) {
  std::string known;
  for (const auto& [kind, kind_name] : kKindNames) {
    if (name == kind_name) return kind;
    known += (known.empty() ? "" : ", ") + std::string(kind_name);
  }
  throw std::invalid_argument(fmt::format("unknown pattern {}; known are {}", name, known));
}

const char* pattern_kind_name(PatternKind kind) {
  for (const auto& [known, name] : kKindNames) {
    if (known == kind) return name.data();
  }
  throw std::invalid_argument(fmt::format("pattern kind {} does not exist", static_cast<int>(kind)));
}

SamplePattern::SamplePattern(std::shared_ptr<const Directions> directions, std::vector<float> lengths)
    : directions_(std::move(directions)), lengths_(std::make_shared<const std::vector<float>>(std::move(lengths))) {}

SamplePattern SamplePattern::make(PatternKind kind, int ray_count, const Falloff& falloff, std::uint64_t seed,
                                  Weighting weighting) {
  require_valid_ray_count(ray_count);
  require_known(weighting);
  std::vector<glm::vec2> points;
  const std::vector<glm::dvec2> spread = lut::pattern_points(kind, ray_count, seed, weighting);
  std::transform(spread.begin(), spread.end(), std::back_inserter(points), inside_disk);
  std::sort(points.begin(), points.end(),
            [](const glm::vec2& a, const glm::vec2& b) { return lut::hilbert_index(a) < lut::hilbert_index(b); });
  if (weighting == Weighting::uniform) {
    for (glm::vec2& point : points) point = inside_disk(lut::to_uniform(point));
  }
  return from_points(points, std::vector<float>(points.size(), 1.0f), weighting).with_falloff(falloff);
}

SamplePattern SamplePattern::relaxed(int ray_count, const Falloff& falloff, std::uint64_t seed, Weighting weighting) {
  return make(PatternKind::lloyd, ray_count, falloff, seed, weighting);
}

const SamplePattern& SamplePattern::standard(int ray_count, Weighting weighting) {
  struct Kept {
    std::once_flag once;
    std::optional<SamplePattern> pattern;
  };
  static std::array<Kept, kMaxRayCount + 1> cosine, uniform;
  require_valid_ray_count(ray_count);
  require_known(weighting);
  Kept& kept = (weighting == Weighting::cosine ? cosine : uniform)[static_cast<std::size_t>(ray_count)];
  std::call_once(kept.once, [&] { kept.pattern = relaxed(ray_count, Falloff::constant(), 0, weighting); });
  return *kept.pattern;
}

SamplePattern SamplePattern::from_disk(std::span<const glm::vec2> points, std::span<const float> lengths) {
  return from_points(points, lengths, Weighting::cosine);
}

SamplePattern SamplePattern::from_points(std::span<const glm::vec2> points, std::span<const float> lengths,
                                         Weighting weighting) {
  require_valid_ray_count(static_cast<std::int64_t>(points.size()));
  if (lengths.size() != points.size()) {
    throw std::invalid_argument(fmt::format("{} points but {} lengths", points.size(), lengths.size()));
  }
  auto directions = std::make_shared<Directions>();
  float lowest = 1.0f;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::vec3 direction = lift(points[i]);
    if (!(direction.z > 0.0f)) {
      throw std::invalid_argument(
          fmt::format("point {} ({}, {}) is not inside the unit disk", i, points[i].x, points[i].y));
    }
    if (!(lengths[i] >= 0.0f && lengths[i] <= 1.0f)) {
      throw std::invalid_argument(fmt::format("length {} must be in [0, 1], not {}", i, lengths[i]));
    }
    lowest = std::min(lowest, direction.z);
    directions->directions.push_back(direction);
  }
  directions->disk.assign(points.begin(), points.end());
  directions->lowest_elevation = std::asin(lowest);
  directions->weighting = weighting;
  return {std::move(directions), std::vector<float>(lengths.begin(), lengths.end())};
}

SamplePattern SamplePattern::with_falloff(const Falloff& falloff) const {
  const std::vector<float> sorted = stratified_lengths(directions_->disk.size(), falloff);
  if (sorted.front() == sorted.back()) return {directions_, sorted};  // whoever gets which
  std::vector<float> lengths;
  for (int share : directions_->shares()) lengths.push_back(sorted[static_cast<std::size_t>(share)]);
  return {directions_, std::move(lengths)};
}

int SamplePattern::ray_count() const { return static_cast<int>(directions_->disk.size()); }
std::span<const glm::vec2> SamplePattern::disk() const { return directions_->disk; }
std::span<const glm::vec3> SamplePattern::directions() const { return directions_->directions; }
std::span<const float> SamplePattern::lengths() const { return *lengths_; }
float SamplePattern::lowest_elevation() const { return directions_->lowest_elevation; }

}  // namespace lkao
