// The occluders on the GPU, sorted into shapes by every draw, and the draws of these shapes.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "gpu/gl_objects.h"
#include "gpu/triangle_buffers.h"
#include "lkao/gl.h"

namespace lkao::gl {

class Occluders {
 public:
  Occluders();

  // `ranges`: none, or one for each triangle. Throws std::invalid_argument for an index out of range or a range that is
  // none, std::runtime_error for a mesh beyond the driver's limits.
  void set(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
           std::span<const glm::vec2> ranges = {});
  void update(std::span<const glm::vec3> positions);
  ObjectName positions_buffer() const { return positions_.name(); }
  bool has_ranges() const { return has_ranges_; }

  // Runs the program "classify.comp" over all triangles. Afterwards shaders may read all of it.
  void classify(GLuint program, bool two_sided) const;
  // With the program for that shape in use, after classify().
  void draw(Shape shape, GeometryBackEnd back_end) const;

 private:
  std::size_t position_count_ = 0;
  bool has_ranges_ = false;
  Buffer positions_, largest_;  // the largest coordinate, the bits of a float
  Texture positions_texture_, largest_texture_;
  std::vector<TriangleBuffers> triangles_;  // more than one where there are more than a buffer takes
  // Of a batch of triangles.
  Buffer prism_indices_, billboard_indices_;
  VertexArray no_attributes_, pulled_prisms_, pulled_billboards_;
};

}  // namespace lkao::gl
