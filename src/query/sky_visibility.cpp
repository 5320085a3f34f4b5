#include "lkao/sky_visibility.h"

#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "query/answer.h"

namespace lkao {
namespace {

// Turns of the two sides have nothing to do with each other.
constexpr std::uint64_t kOtherSeed = 0x9e3779b97f4a7c15u;

const SamplePattern& half_pattern(int ray_count) {
  if (ray_count < 2 || ray_count > 2 * kMaxRayCount) {
    throw std::invalid_argument(fmt::format("ray_count must be from 2 to {}, not {}", 2 * kMaxRayCount, ray_count));
  }
  return SamplePattern::standard((ray_count + 1) / 2, Weighting::uniform);
}

RayOptions ray_options(const SkyOptions& options, std::uint64_t seed) {
  return {
      .radius = options.radius, .sidedness = options.sidedness, .seed = seed, .surface_offset = options.surface_offset};
}

// The receiver on one side of its surface: no ray of the hemisphere is below the horizon.
Receiver on_side(const Receiver& receiver, float sign) {
  Receiver side = receiver;
  if (receiver.geometric_normal != glm::vec3(0)) side.normal = receiver.geometric_normal;
  side.normal *= sign;
  side.geometric_normal = glm::vec3(0);
  return side;
}

SkyShares shares_of(float occlusion_above, float occlusion_below) {
  const float above = 1 - occlusion_above, below = 1 - occlusion_below;
  return {(above + below) / 2, above, below};
}

}  // namespace

SkyVisibility::SkyVisibility(OccluderScene occluders, int ray_count, const SkyOptions& options, Kernel kernel)
    : above_(occluders, half_pattern(ray_count), ray_options(options, options.seed), kernel),
      below_(std::move(occluders), half_pattern(ray_count), ray_options(options, options.seed ^ kOtherSeed), kernel) {}

SkyShares SkyVisibility::query(const Receiver& receiver, std::uint64_t index) const {
  return shares_of(above_.query(on_side(receiver, 1), index).occlusion,
                   below_.query(on_side(receiver, -1), index).occlusion);
}

QueryReport SkyVisibility::query(std::span<const Receiver> receivers, std::span<SkyShares> shares,
                                 std::uint64_t first_index, const Progress& progress) const {
  const std::size_t count = receivers.size();
  if (shares.size() != count) {
    throw std::invalid_argument(fmt::format("shares has {} entries, not {}", shares.size(), count));
  }
  std::vector<Receiver> sides(count);
  std::vector<float> above(count), below(count);
  const auto ask = [&](const AmbientOcclusion& ao, float sign, std::size_t done, std::vector<float>& occlusion) {
    for (std::size_t k = 0; k < count; ++k) sides[k] = on_side(receivers[k], sign);
    Progress both;
    if (progress) both = [&, done](std::size_t part, std::size_t) { return progress(done + part, 2 * count); };
    return ao.query(sides, {.occlusion = occlusion}, first_index, both);
  };
  QueryReport report = ask(above_, 1, 0, above);
  const QueryReport other = ask(below_, -1, count, below);
  report.ray_count += other.ray_count;
  report.blocked_ray_count += other.blocked_ray_count;
  for (std::size_t k = 0; k < count; ++k) shares[k] = shares_of(above[k], below[k]);
  return report;
}

}  // namespace lkao
