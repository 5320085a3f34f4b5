#include "bvh/cut_outs.h"

#include <stdexcept>

#include <fmt/format.h>

#include "lut/random.h"

namespace lkao::bvh {

std::uint64_t receiver_key(std::uint64_t seed, std::uint64_t index) {
  // Not the numbers that the jitter is drawn from.
  return lut::mix_bits(lut::mix_bits(seed ^ 0x6c656176656573u) + index);
}

bool is_blocked_there(const CutOuts& cut_outs, const HoleGrids* grids, std::uint32_t instance, std::uint32_t primitive,
                      const glm::dvec2& place, const RayKey& key) {
  if (!asks_for_places(cut_outs)) return is_blocked_anywhere(cut_outs, instance, primitive, key);
  const auto u = static_cast<float>(place.x), v = static_cast<float>(place.y);
  const CutOutPart part = grids != nullptr ? grids->at(primitive, u, v) : CutOutPart::mixed;
  return part == CutOutPart::mixed ? cut_outs.blocks(instance, primitive, u, v) : part == CutOutPart::opaque;
}

bool is_blocked_anywhere(const CutOuts& cut_outs, std::uint32_t instance, std::uint32_t primitive, const RayKey& key) {
  const std::uint64_t triangle = std::uint64_t{instance} << 32 | primitive;
  const std::uint64_t of_ray = key.receiver + static_cast<std::uint64_t>(key.ray) * 0x9e3779b97f4a7c15u;
  lut::RandomStream random(lut::mix_bits(of_ray) ^ triangle);
  return random.next_double() < static_cast<double>(cut_outs.opacities[primitive]);
}

namespace {

void check_count(const char* name, std::size_t count, std::size_t triangle_count) {
  if (count == 0 || count == triangle_count) return;
  throw std::invalid_argument(
      fmt::format("cut_outs.{} must be none or one for each of {} triangles, not {}", name, triangle_count, count));
}

}  // namespace

void check(const CutOuts& cut_outs, std::size_t triangle_count) {
  const std::vector<float>& opacities = cut_outs.opacities;
  check_count("opacities", opacities.size(), triangle_count);
  check_count("looks", cut_outs.looks.size(), triangle_count);
  if (cut_outs.survey && !cut_outs.blocks) {
    throw std::invalid_argument("cut_outs.survey must be empty without cut_outs.blocks, which it speaks of");
  }
  for (std::size_t i = 0; i < opacities.size(); ++i) {
    if (opacities[i] >= 0 && opacities[i] <= 1) continue;
    throw std::invalid_argument(fmt::format("cut_outs.opacities[{}] must be from 0 to 1, not {}", i, opacities[i]));
  }
}

}  // namespace lkao::bvh
