// Receivers for tests.
#pragma once

#include <cstdint>
#include <vector>

#include "lkao/ambient_occlusion.h"
#include "support/meshes.h"

namespace lkao::tests {

// In [-half_size, half_size]^3, with any normal; every third has another geometric normal.
inline std::vector<Receiver> random_receivers(int count, float half_size, std::uint64_t seed) {
  lut::RandomStream random(seed);
  std::vector<Receiver> receivers;
  for (int i = 0; i < count; ++i) {
    receivers.push_back({.position = random_point(random, half_size), .normal = random_direction(random)});
    if (i % 3 == 0) receivers.back().geometric_normal = receivers.back().normal + random_direction(random) * 0.5f;
  }
  return receivers;
}

// Receivers 0, step, 2 step ... exclude the primitive of their own number.
inline std::vector<Receiver> with_exclusions(std::vector<Receiver> receivers, std::size_t step) {
  for (std::size_t i = 0; i < receivers.size(); i += step) {
    receivers[i].excluded_primitive = static_cast<std::uint32_t>(i);
  }
  return receivers;
}

}  // namespace lkao::tests
