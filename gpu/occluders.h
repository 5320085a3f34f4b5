// The occluders on the GPU, sorted into shapes by every draw, and the draws of these shapes.
#pragma once

#include <cstddef>
#include <span>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "gpu/gl_objects.h"
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
  std::size_t triangle_count() const { return triangle_count_; }
  bool has_ranges() const { return has_ranges_; }

  // Runs the program "classify.comp" over all triangles. Afterwards shaders may read all of it.
  void classify(GLuint program, bool two_sided) const;
  // What shapes and receivers read; the list is bound by the draws.
  void bind() const;
  // With the program for that shape in use.
  void draw_prisms(GeometryBackEnd back_end) const;
  void draw_billboards(GeometryBackEnd back_end) const;

 private:
  void draw(GeometryBackEnd back_end, const Texture& list, int arrays_word, int elements_word,
            const VertexArray& pulled) const;

  std::size_t position_count_ = 0;
  std::size_t triangle_count_ = 0;
  bool has_ranges_ = false;
  Buffer positions_, triangles_, ranges_, frames_, prisms_, billboards_, draws_;
  Texture positions_texture_, triangles_texture_, ranges_texture_, frames_texture_, prisms_texture_,
      billboards_texture_, draws_texture_;
  // Of a batch of triangles.
  Buffer prism_indices_, billboard_indices_;
  VertexArray no_attributes_, pulled_prisms_, pulled_billboards_;
};

}  // namespace lkao::gl
