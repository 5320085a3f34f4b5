#include "gpu/mesh/shape_lists.h"

#include <array>
#include <bit>
#include <cstdint>

#include "gpu/mesh/dispatch.h"
#include "gpu/mesh/draw_words.h"
#include "gpu/mesh/units.h"

namespace lkao::gl {
namespace {

using Strip = std::array<int, LKAO_SHAPE_VERTEX_COUNT>;
// As in prism.glsl and billboard.glsl.
constexpr Strip kPrismStrips[2] = {{6, 7, 11, 8, 10, 9, 4, 3, 5, 2, 0, 1}, {10, 4, 11, 5, 6, 0, 7, 1, 8, 2, 9, 3}};
constexpr Strip kPolygonStrip = {0, 1, 11, 2, 10, 3, 9, 4, 8, 5, 7, 6};

void add_strip(const Strip& strip, int first_vertex, std::vector<std::uint16_t>& indices) {
  for (std::size_t i = 0; i + 2 < strip.size(); ++i) {
    // Every second triangle of a strip runs the other way round.
    const std::size_t second = i % 2 == 0 ? i + 1 : i + 2, third = i % 2 == 0 ? i + 2 : i + 1;
    for (std::size_t corner : {i, second, third}) {
      indices.push_back(static_cast<std::uint16_t>(first_vertex + strip[corner]));
    }
  }
}

std::vector<std::uint16_t> prism_indices(const Solid& prism) {
  std::vector<std::uint16_t> indices;
  for (int i = 0; i < LKAO_BATCH_SIZE; ++i) {
    for (const std::uint16_t index : prism.indices) {
      indices.push_back(static_cast<std::uint16_t>(i * prism.vertex_count + index));
    }
  }
  return indices;
}

// First the batch's first polygons, then its second ones, which two-sided triangles do not have.
std::vector<std::uint16_t> billboard_indices() {
  std::vector<std::uint16_t> indices;
  for (int polygon = 0; polygon < 2; ++polygon) {
    for (int i = 0; i < LKAO_BATCH_SIZE; ++i) {
      add_strip(kPolygonStrip, (2 * i + polygon) * LKAO_SHAPE_VERTEX_COUNT, indices);
    }
  }
  return indices;
}

Buffer make_index_buffer(const std::vector<std::uint16_t>& indices) {
  return make_buffer(static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint16_t)), indices.data(), 0);
}

VertexArray make_indexed(const Buffer& indices) {
  VertexArray array = make_vertex_array();
  glVertexArrayElementBuffer(array.name(), indices.name());
  return array;
}

// Draw commands before any triangle is counted.
std::array<std::uint32_t, LKAO_DRAW_WORD_COUNT> empty_draws(std::size_t prism_index_count, bool is_two_sided) {
  std::array<std::uint32_t, LKAO_DRAW_WORD_COUNT> words{};
  words[LKAO_DRAW_PRISM_ARRAYS + 1] = 1;
  words[LKAO_DRAW_BILLBOARD_ARRAYS + 1] = 1;
  // A billboard has two polygons of one strip, but one for a two-sided triangle.
  constexpr std::uint32_t kStripIndices = (LKAO_SHAPE_VERTEX_COUNT - 2) * 3;
  words[LKAO_DRAW_PRISM_ELEMENTS] = LKAO_BATCH_SIZE * static_cast<std::uint32_t>(prism_index_count);
  words[LKAO_DRAW_BILLBOARD_ELEMENTS] = LKAO_BATCH_SIZE * kStripIndices * (is_two_sided ? 1u : 2u);
  return words;
}

// Where a command starts in the buffer, as OpenGL wants to be told: by a pointer.
const void* command(int word) { return std::bit_cast<const void*>(static_cast<std::uintptr_t>(word) * 4); }

}  // namespace

const Solid& hexagonal_prism() {
  static const std::vector<std::uint16_t> indices = [] {
    std::vector<std::uint16_t> of_both;
    for (const Strip& strip : kPrismStrips) add_strip(strip, 0, of_both);
    return of_both;
  }();
  static const Solid prism{LKAO_SHAPE_VERTEX_COUNT, indices};
  return prism;
}

ShapeLists::ShapeLists(const Solid& prism)
    : largest_(make_buffer(4, nullptr, GL_DYNAMIC_STORAGE_BIT)),
      largest_texture_(make_buffer_texture(GL_R32F, largest_)),
      prism_index_count_(prism.indices.size()),
      prism_indices_(make_index_buffer(prism_indices(prism))),
      billboard_indices_(make_index_buffer(billboard_indices())),
      no_attributes_(make_vertex_array()),
      pulled_prisms_(make_indexed(prism_indices_)),
      pulled_billboards_(make_indexed(billboard_indices_)) {}

void ShapeLists::make_room(const MeshBuffers& mesh) {
  for (std::size_t i = 0; i < mesh.part_count(); ++i) {
    if (i < parts_.size() && parts_[i].capacity >= mesh.triangle_count(i)) continue;
    if (i < parts_.size()) {
      parts_[i] = Part(mesh.triangle_count(i));
    } else {
      parts_.emplace_back(mesh.triangle_count(i));
    }
  }
}

void ShapeLists::classify(const MeshBuffers& mesh, GLuint program, bool is_two_sided) {
  make_room(mesh);
  const GLuint zero = 0;
  glNamedBufferSubData(largest_.name(), 0, sizeof(zero), &zero);
  mesh.bind_positions();
  bind_largest();
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_LARGEST, largest_.name());
  glUseProgram(program);
  for (std::size_t i = 0; i < mesh.part_count(); ++i) {
    mesh.bind_triangles(i);
    mesh.bind_opacities(i);
    parts_[i].classify(mesh.triangle_count(i), prism_index_count_, is_two_sided);
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void ShapeLists::draw(const MeshBuffers& mesh, Shape shape, GeometryBackEnd back_end, const BindPart& bind_more) const {
  const VertexArray& pulled = shape == Shape::prism ? pulled_prisms_ : pulled_billboards_;
  const bool is_pulled = back_end == GeometryBackEnd::vertex_pulling;
  glBindVertexArray((is_pulled ? pulled : no_attributes_).name());
  for (std::size_t i = 0; i < mesh.part_count(); ++i) {
    mesh.bind_triangles(i);
    parts_[i].bind(shape);
    if (bind_more) bind_more(i);
    if (is_pulled) {
      parts_[i].draw_batches(shape);
    } else {
      parts_[i].draw_points(shape);
    }
  }
}

void ShapeLists::bind_largest() const { glBindTextureUnit(LKAO_UNIT_LARGEST, largest_texture_.name()); }

void ShapeLists::bind_frames(std::size_t part) const {
  glBindTextureUnit(LKAO_UNIT_FRAMES, parts_[part].frames_texture.name());
}

ShapeLists::Part::Part(std::size_t triangle_count)
    : capacity(triangle_count),
      frames(make_buffer(static_cast<GLsizeiptr>(capacity * 16 * kFrameTexels), nullptr, 0)),
      prisms(make_buffer(static_cast<GLsizeiptr>(capacity * 4), nullptr, 0)),
      billboards(make_buffer(static_cast<GLsizeiptr>(capacity * 4), nullptr, 0)),
      draws(make_buffer(GLsizeiptr{4} * LKAO_DRAW_WORD_COUNT, nullptr, GL_DYNAMIC_STORAGE_BIT)),
      frames_texture(make_buffer_texture(GL_RGBA32F, frames)),
      prisms_texture(make_buffer_texture(GL_R32UI, prisms)),
      billboards_texture(make_buffer_texture(GL_R32UI, billboards)),
      draws_texture(make_buffer_texture(GL_R32UI, draws)) {}

void ShapeLists::Part::classify(std::size_t triangle_count, std::size_t prism_index_count, bool is_two_sided) const {
  const auto words = empty_draws(prism_index_count, is_two_sided);
  glNamedBufferSubData(draws.name(), 0, sizeof(words), words.data());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_DRAWS, draws.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_PRISMS, prisms.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_BILLBOARDS, billboards.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_FRAMES, frames.name());
  dispatch_for_each(triangle_count);
}

void ShapeLists::Part::bind(Shape shape) const {
  glBindTextureUnit(LKAO_UNIT_FRAMES, frames_texture.name());
  glBindTextureUnit(LKAO_UNIT_DRAWS, draws_texture.name());
  glBindTextureUnit(LKAO_UNIT_LIST, (shape == Shape::prism ? prisms_texture : billboards_texture).name());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, draws.name());
}

void ShapeLists::Part::draw_points(Shape shape) const {
  glDrawArraysIndirect(GL_POINTS, command(shape == Shape::prism ? LKAO_DRAW_PRISM_ARRAYS : LKAO_DRAW_BILLBOARD_ARRAYS));
}

void ShapeLists::Part::draw_batches(Shape shape) const {
  glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT,
                         command(shape == Shape::prism ? LKAO_DRAW_PRISM_ELEMENTS : LKAO_DRAW_BILLBOARD_ELEMENTS));
}

}  // namespace lkao::gl
