// Cutting a triangle's bounds in two, for spatial splits.
#pragma once

#include <cstdint>

#include <embree3/rtcore.h>

#include "lkao/occluder_bvh.h"

namespace lkao::bvh {

// A mesh whose triangles are cut, in one build. It must stay as it is meanwhile.
class ClipMesh {
 public:
  explicit ClipMesh(const TriangleMesh& triangle_mesh);

  const TriangleMesh mesh;
  const std::uint64_t number;  // no other has it
};

// Embree's callback. Boxes of the parts of the triangle piece->primID on either side of the plane `axis` = `position`,
// both within the box `piece`. Rounded outwards, so that the two together hold every point of the triangle inside that
// box. A triangle that at most touches the plane stays whole, and the other box is empty (lower > upper). No coordinate
// may be beyond kLargestCoordinate. For any number of threads.
void split_triangle(const RTCBuildPrimitive* piece, unsigned axis, float position, RTCBounds* left, RTCBounds* right,
                    void* clip_mesh);

}  // namespace lkao::bvh
