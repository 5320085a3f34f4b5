// Masks of the planes of one cell, 4 to 16 rays at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "lut/plane_cells.h"

namespace lkao::lut {

// Ends of the rays of a pattern, component by component, and their distances from the origin.
struct RayEnds {
  std::vector<float> x, y, z, length;  // up to whole words of a mask
  int word_count = 0;
  std::uint64_t last_word = ~std::uint64_t{0};  // the bits of it that belong to rays
};

// Rays beyond the plane in the middle of the cell: axis . P >= distance.
void fill_nearest(const RayEnds& ends, const PlaneCell& cell, std::uint64_t* words);

// Rays beyond every plane of the cell, and rays beyond some plane of it; both with a margin of kPlaneMargin.
void fill_must_may(const RayEnds& ends, const PlaneCell& cell, std::uint64_t* must, std::uint64_t* may);

// How far (in radii, and so for unit vectors in radians) must and may look beyond the cell: for the rounding of the
// planes that are looked up, and of the table's own arithmetic.
inline constexpr float kPlaneMargin = 2.5e-5f;

}  // namespace lkao::lut
