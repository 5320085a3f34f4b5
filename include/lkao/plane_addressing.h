// Ways to find the cell of a plane.
#pragma once

#include "lkao/requirements.h"

namespace lkao {

// How a plane finds its cell. lut/README.md compares their errors at equal memory.
enum class PlaneAddressing {
  // The paper's: normal x (1 - 7/8 d/r), stretched to the corners of a cube.
  cube,
  // Cube maps of the normal: one fine map for planes through the receiver (edges of triangles), and coarser ones
  // for slices of distance.
  slices,
};

}  // namespace lkao
