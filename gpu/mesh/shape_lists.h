// Which shape bounds the influence of each triangle, found anew in every frame, and the draws of these shapes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "gpu/gl/objects.h"
#include "gpu/mesh/mesh_buffers.h"
#include "gpu/mesh/shapes.h"

namespace lkao::gl {

// The solid around a triangle, vertices numbered from 0, triangles with their fronts outwards.
struct Solid {
  int vertex_count;
  std::span<const std::uint16_t> indices;
};
// The hexagonal one of prism.glsl.
const Solid& hexagonal_prism();

// Room for what a pass knows of a mesh while it draws; grows with the largest mesh.
class ShapeLists {
 public:
  // What is drawn for Shape::prism.
  explicit ShapeLists(const Solid& prism = hexagonal_prism());

  // Runs the program "mesh/classify.comp" over all triangles. Afterwards shaders may read all of it.
  void classify(const MeshBuffers& mesh, GLuint program, bool is_two_sided);
  // What else shaders read of a part of the mesh.
  using BindPart = std::function<void(std::size_t part)>;
  // With the program for that shape in use, after classify() of the same mesh.
  void draw(const MeshBuffers& mesh, Shape shape, GeometryBackEnd back_end, const BindPart& bind_more = {}) const;
  // For a shader that looks at all triangles of a part, after classify().
  void bind_frames(std::size_t part) const;
  void bind_largest() const;

 private:
  // Of one part of a mesh.
  struct Part {
    explicit Part(std::size_t triangle_count);
    void classify(std::size_t triangle_count, std::size_t prism_index_count, bool is_two_sided) const;
    void bind(Shape shape) const;
    // All triangles of the list, a point each, or instances of LKAO_BATCH_SIZE of them. For what is bound.
    void draw_points(Shape shape) const;
    void draw_batches(Shape shape) const;

    std::size_t capacity;
    Buffer frames, prisms, billboards, draws;
    Texture frames_texture, prisms_texture, billboards_texture, draws_texture;
  };
  void make_room(const MeshBuffers& mesh);

  Buffer largest_;  // the largest coordinate, the bits of a float
  Texture largest_texture_;
  std::vector<Part> parts_;
  std::size_t prism_index_count_;  // of one
  // Of a batch of triangles.
  Buffer prism_indices_, billboard_indices_;
  VertexArray no_attributes_, pulled_prisms_, pulled_billboards_;
};

}  // namespace lkao::gl
