// Sets of 8 lanes as lists: for vectors whose instruction set has no compressing store, or a slow one.
#pragma once

#include <cstdint>

namespace lkao::bvh {

// Row `lanes` has the numbers of the bits that are set in it, in order, then zeros.
class LaneLists {
 public:
  constexpr LaneLists() {
    for (int lanes = 0; lanes < 256; ++lanes) {
      int count = 0;
      for (int lane = 0; lane < 8; ++lane) {
        if ((lanes >> lane & 1) != 0) rows_[lanes][count++] = static_cast<std::uint8_t>(lane);
      }
    }
  }
  constexpr const std::uint8_t* operator[](std::uint32_t lanes) const { return rows_[lanes]; }

 private:
  alignas(64) std::uint8_t rows_[256][8] = {};
};
inline constexpr LaneLists kLaneLists;

// The numbers themselves. Made in registers they would take a store a lane.
alignas(64) inline constexpr std::uint32_t kLaneNumbers[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

}  // namespace lkao::bvh
