#include "lkao/sample_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numbers>
#include <numeric>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "lut/disk_relaxation.h"
#include "lut/hilbert.h"

namespace lkao {

struct SamplePattern::Data {
  std::vector<glm::vec2> disk;
  std::vector<glm::vec3> directions;
  std::vector<float> lengths;
  float lowest_elevation = 0;
};

namespace {

void require_valid_ray_count(std::size_t ray_count) {
  if (ray_count > kMaxRayCount || !is_valid_ray_count(static_cast<int>(ray_count))) {
    throw std::invalid_argument(fmt::format("ray count must be a multiple of {} from {} to {}, not {}", kRayCountStep,
                                            kMinRayCount, kMaxRayCount, ray_count));
  }
}

// Cosine-weighted: points spread evenly over the disk, lifted to the hemisphere (Laine & Karras 2010, Sec. 6).
glm::vec3 lift(const glm::vec2& point) {
  const double x = point.x, y = point.y;
  return {point.x, point.y, static_cast<float>(std::sqrt(1.0 - x * x - y * y))};
}

// Lengths with P(length >= x) = rho(x) (Eq. 3), one in each of ray_count equal shares of rho. Which share a ray gets
// follows the golden ratio along the ray's index, so neighbours on the curve have shares far apart.
std::vector<float> stratified_lengths(std::size_t ray_count, const Falloff& falloff) {
  std::vector<double> places(ray_count);
  for (std::size_t i = 0; i < ray_count; ++i) {
    const double step = static_cast<double>(i) * (std::numbers::phi - 1.0);
    places[i] = step - std::floor(step);
  }
  std::vector<std::size_t> order(ray_count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return places[a] < places[b]; });
  std::vector<float> lengths(ray_count);
  for (std::size_t rank = 0; rank < ray_count; ++rank) {
    const double share = (static_cast<double>(rank) + 0.5) / static_cast<double>(ray_count);
    lengths[order[rank]] = static_cast<float>(falloff.length_at(share));
  }
  return lengths;
}

}  // namespace

bool is_valid_ray_count(int ray_count) {
  return ray_count >= kMinRayCount && ray_count <= kMaxRayCount && ray_count % kRayCountStep == 0;
}

SamplePattern SamplePattern::relaxed(int ray_count, const Falloff& falloff, std::uint64_t seed) {
  require_valid_ray_count(ray_count < 0 ? 0 : static_cast<std::size_t>(ray_count));
  const std::vector<glm::dvec2> relaxed = lut::relaxed_points(ray_count, seed);
  std::vector<glm::vec2> points(relaxed.begin(), relaxed.end());
  std::sort(points.begin(), points.end(),
            [](const glm::vec2& a, const glm::vec2& b) { return lut::hilbert_index(a) < lut::hilbert_index(b); });
  return from_disk(points, stratified_lengths(points.size(), falloff));
}

const SamplePattern& SamplePattern::standard(int ray_count) {
  constexpr std::size_t kPatternCount = kMaxRayCount / kRayCountStep;
  static std::array<std::once_flag, kPatternCount> made;
  static std::array<std::optional<SamplePattern>, kPatternCount> patterns;
  require_valid_ray_count(ray_count < 0 ? 0 : static_cast<std::size_t>(ray_count));
  const std::size_t slot = static_cast<std::size_t>(ray_count / kRayCountStep - 1);
  std::call_once(made[slot], [&] { patterns[slot] = relaxed(ray_count); });
  return *patterns[slot];
}

SamplePattern SamplePattern::from_disk(std::span<const glm::vec2> points, std::span<const float> lengths) {
  require_valid_ray_count(points.size());
  if (lengths.size() != points.size()) {
    throw std::invalid_argument(fmt::format("{} points but {} lengths", points.size(), lengths.size()));
  }
  auto data = std::make_shared<Data>();
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
    data->directions.push_back(direction);
  }
  data->disk.assign(points.begin(), points.end());
  data->lengths.assign(lengths.begin(), lengths.end());
  data->lowest_elevation = std::asin(lowest);
  return SamplePattern(std::move(data));
}

SamplePattern SamplePattern::with_falloff(const Falloff& falloff) const {
  auto data = std::make_shared<Data>(*data_);
  data->lengths = stratified_lengths(data->disk.size(), falloff);
  return SamplePattern(std::move(data));
}

int SamplePattern::ray_count() const { return static_cast<int>(data_->disk.size()); }
std::span<const glm::vec2> SamplePattern::disk() const { return data_->disk; }
std::span<const glm::vec3> SamplePattern::directions() const { return data_->directions; }
std::span<const float> SamplePattern::lengths() const { return data_->lengths; }
float SamplePattern::lowest_elevation() const { return data_->lowest_elevation; }

}  // namespace lkao
