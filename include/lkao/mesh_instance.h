// A mesh that stands somewhere: what a query's scene and the OpenGL passes both take.
#pragma once

#include <glm/mat4x3.hpp>

#include "lkao/index_view.h"
#include "lkao/position_view.h"
#include "lkao/requirements.h"

namespace lkao {

// A mesh, in arrays of any layout and in a space of its own, and where it stands. Instances of the same arrays share
// one copy of them.
struct MeshInstance {
  PositionView positions;
  IndexView triangles;
  // Any affine transform to the world, mirrors and shears too. Positions there are found in double precision and
  // rounded once to float. Which side of a triangle is its front is decided in the mesh's own space: a mirror changes
  // no front.
  glm::mat4x3 to_world{1};
};

}  // namespace lkao
