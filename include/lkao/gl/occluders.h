// A mesh on the GPU, for the passes that draw geometry.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include <glm/mat4x3.hpp>
#include <glm/vec2.hpp>

#include "lkao/export.h"
#include "lkao/gl/frame.h"
#include "lkao/gl/status.h"
#include "lkao/index_view.h"
#include "lkao/mesh_instance.h"
#include "lkao/position_view.h"
#include "lkao/requirements.h"

namespace lkao::gl {

// How shapes around triangles are made.
enum class GeometryBackEnd {
  automatic,        // the first of these that passes the driver's check: vertex_pulling, geometry_shader
  geometry_shader,  // the paper's
  vertex_pulling,   // indexed draws without vertex attributes
};

using lkao::MeshInstance;

class MeshBuffers;
class Instances;

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
  Occluders(const PositionView& positions, const IndexView& triangles, std::span<const glm::vec2> ranges = {},
            HostErrors host_errors = HostErrors::reported);
  // Several meshes, and meshes in several places. Front faces are counter-clockwise as seen in the mesh's own space:
  // a mirror changes no front. Throws as above, and where a transform is not finite. Takes 12 bytes a position of each
  // mesh, and of each instance what a mesh takes, since every instance has its own triangles in the world.
  explicit Occluders(std::span<const MeshInstance> instances, HostErrors host_errors = HostErrors::reported);
  ~Occluders();
  Occluders(Occluders&&) noexcept;
  Occluders& operator=(Occluders&&) noexcept;

  // New positions for the same triangles, as many as before. Nothing is rebuilt: passes find bounds anew in every
  // frame. Throws std::runtime_error for occluders that are made of instances.
  void update_positions(const PositionView& positions);
  // Where the instances stand from now on, as many as there are: costs their matrices and a shader over all positions.
  // Throws std::invalid_argument where a transform is not finite, or mirrors where the first did not, and
  // std::runtime_error where these occluders are not made of instances.
  void update_transforms(std::span<const glm::mat4x3> to_world);
  // How much each triangle blocks of what it covers, from 0 to 1: the mean alpha of a texture with holes, such as a
  // fence or leaves. VolumePass takes it; what tells ray by ray does not. None: all block everything. With instances,
  // of each instance's triangles. Costs 4 bytes a triangle. Throws std::invalid_argument where there are not as many as
  // triangles, or one is out of range.
  void set_opacities(std::span<const float> opacities);
  // The buffer of positions in the world, three floats each, for meshes that move on the GPU: write there between
  // draws, with glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT) after a shader. As long-lived as this object.
  ObjectName positions_buffer() const;

  // The same for programs without exceptions; `try_make` gives none where it fails.
  static std::optional<Occluders> try_make(const PositionView& positions, const IndexView& triangles,
                                           Status& status) noexcept;
  static std::optional<Occluders> try_make(std::span<const MeshInstance> instances, Status& status) noexcept;
  Status try_update_positions(const PositionView& positions) noexcept;
  Status try_update_transforms(std::span<const glm::mat4x3> to_world) noexcept;
  Status try_set_opacities(std::span<const float> opacities) noexcept;

  // For the passes of this library.
  const MeshBuffers& buffers() const { return *buffers_; }

 private:
  HostErrors host_errors_;
  std::unique_ptr<MeshBuffers> buffers_;
  std::unique_ptr<Instances> instances_;  // none: a mesh in the world
};

}  // namespace lkao::gl
