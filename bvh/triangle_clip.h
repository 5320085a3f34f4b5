// Cutting a triangle's bounds in two, for spatial splits.
#pragma once

#include <cstdint>
#include <utility>

#include "bvh/lanes.h"
#include "bvh/packed_mesh.h"

namespace lkao::bvh {

// Boxes of the parts of a triangle on either side of the plane `axis` = `position`, left and right, both within the box
// `within`. Rounded outwards, so that the two together hold every point of the triangle inside that box. A triangle
// that at most touches the plane stays whole, and the other box is empty. No coordinate may be beyond
// kLargestCoordinate.
std::pair<Box, Box> cut_triangle(const PackedMesh& mesh, std::uint32_t primitive, const Box& within, int axis,
                                 float position);

}  // namespace lkao::bvh
