// A mesh on the GPU, for the passes that draw geometry.
#pragma once

#include <memory>
#include <span>

#include <glm/vec2.hpp>

#include "lkao/export.h"
#include "lkao/gl/frame.h"
#include "lkao/index_view.h"
#include "lkao/position_view.h"
#include "lkao/requirements.h"

namespace lkao::gl {

// How shapes around triangles are made.
enum class GeometryBackEnd {
  automatic,        // the first of these that passes the driver's check: vertex_pulling, geometry_shader
  geometry_shader,  // the paper's
  vertex_pulling,   // indexed draws without vertex attributes
};

class MeshBuffers;

// What blocks rays. One copy of a mesh serves any number of passes of the same context.
//
// Every member needs the context in which the object was made, current in the calling thread; the destructor too. They
// leave the context's state as they find it. Errors of OpenGL throw std::runtime_error, wrong arguments
// std::invalid_argument, both with one line.
class LKAO_API Occluders {
 public:
  // None: nothing is blocked.
  Occluders();
  // Copies the mesh, in arrays of any layout, to the GPU; front faces are counter-clockwise. Triangles without area or
  // with a coordinate that is not finite or beyond 1e18 block nothing. Where positions are less an origin
  // (PositionView), the camera must be too. `ranges`, where it is not empty, has [r_min, r_max] for each triangle: it
  // blocks a ray only where the distance from the receiver is in that range, as one of several levels of detail
  // (OccluderLevel). Throws std::invalid_argument where an index is outside `positions`, or a range is not 0 <= r_min <
  // r_max, std::runtime_error where there are more positions than GL_MAX_TEXTURE_BUFFER_SIZE. Takes 12 bytes a position
  // and 12 bytes a triangle, 20 with ranges; each pass that draws it takes 40 bytes a triangle.
  Occluders(const PositionView& positions, const IndexView& triangles, std::span<const glm::vec2> ranges = {});
  ~Occluders();
  Occluders(Occluders&&) noexcept;
  Occluders& operator=(Occluders&&) noexcept;

  // New positions for the same triangles, as many as before. Nothing is rebuilt: passes find bounds anew in every
  // frame.
  void update_positions(const PositionView& positions);
  // The buffer of positions, three floats each, for meshes that move on the GPU: write there between draws, with
  // glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT) after a shader. As long-lived as this object.
  ObjectName positions_buffer() const;

  // For the passes of this library.
  const MeshBuffers& buffers() const { return *buffers_; }

 private:
  std::unique_ptr<MeshBuffers> buffers_;
};

}  // namespace lkao::gl
