// Speeds as they are told.
#pragma once

#include <cstdint>

namespace lkao::method {

// Millions of rays a second; 0 where no time was measured.
inline double mrays_per_second(std::uint64_t ray_count, double seconds) {
  return seconds > 0 ? static_cast<double>(ray_count) / seconds / 1e6 : 0;
}

}  // namespace lkao::method
