// Triangles on the GPU, as many as fit into one set of buffers, and what every frame finds out about them.
#pragma once

#include <cstddef>
#include <span>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "gpu/gl_objects.h"

namespace lkao::gl {

enum class Shape { prism, billboard };

class TriangleBuffers {
 public:
  // How many triangles this driver's buffers take.
  static std::size_t capacity();

  // `ranges`: none, or one for each triangle.
  TriangleBuffers(std::span<const glm::uvec3> triangles, std::span<const glm::vec2> ranges);

  // Runs the program "classify.comp", which is in use, over all triangles: fills lists and draw commands.
  void classify(bool two_sided) const;
  // For the draws below.
  void bind(Shape shape) const;
  // All triangles of the list, a point each, or instances of LKAO_BATCH_SIZE of them. For what is bound.
  void draw_points(Shape shape) const;
  void draw_batches(Shape shape) const;

 private:
  void bind_triangles() const;

  std::size_t count_;
  Buffer triangles_, ranges_, frames_, prisms_, billboards_, draws_;
  Texture triangles_texture_, ranges_texture_, frames_texture_, prisms_texture_, billboards_texture_, draws_texture_;
};

}  // namespace lkao::gl
