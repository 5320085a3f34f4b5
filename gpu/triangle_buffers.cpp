#include "gpu/triangle_buffers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "gpu/shaders/constants.h"

namespace lkao::gl {
namespace {

// The largest of the buffers: two vectors of four floats for each triangle.
constexpr std::size_t kFrameTexels = 2, kFrameBytes = 32;

// Draw commands before any triangle is counted.
std::array<std::uint32_t, LKAO_DRAW_WORD_COUNT> empty_draws(bool two_sided) {
  std::array<std::uint32_t, LKAO_DRAW_WORD_COUNT> words{};
  words[LKAO_DRAW_PRISM_ARRAYS + 1] = 1;
  words[LKAO_DRAW_BILLBOARD_ARRAYS + 1] = 1;
  // A billboard has two polygons of one strip, but one for a two-sided triangle; a prism has two strips.
  constexpr std::uint32_t kStripIndices = (LKAO_SHAPE_VERTEX_COUNT - 2) * 3;
  words[LKAO_DRAW_PRISM_ELEMENTS] = LKAO_BATCH_SIZE * 2 * kStripIndices;
  words[LKAO_DRAW_BILLBOARD_ELEMENTS] = LKAO_BATCH_SIZE * kStripIndices * (two_sided ? 1u : 2u);
  return words;
}

template <typename Value>
Buffer make_buffer_of(std::span<const Value> values) {
  return make_buffer(static_cast<GLsizeiptr>(values.size_bytes()), values.data(), 0);
}

// Where a command starts in the buffer, as OpenGL wants to be told: by a pointer.
const void* command(int word) { return std::bit_cast<const void*>(static_cast<std::uintptr_t>(word) * 4); }

}  // namespace

std::size_t TriangleBuffers::capacity() {
  GLint texels = 0;
  GLint64 block_size = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block_size);
  return std::min(static_cast<std::size_t>(texels) / kFrameTexels, static_cast<std::size_t>(block_size) / kFrameBytes);
}

TriangleBuffers::TriangleBuffers(std::span<const glm::uvec3> triangles, std::span<const glm::vec2> ranges)
    : count_(triangles.size()),
      triangles_(make_buffer_of(triangles)),
      ranges_(make_buffer_of(ranges)),
      frames_(make_buffer(static_cast<GLsizeiptr>(count_ * kFrameBytes), nullptr, 0)),
      prisms_(make_buffer(static_cast<GLsizeiptr>(count_ * 4), nullptr, 0)),
      billboards_(make_buffer(static_cast<GLsizeiptr>(count_ * 4), nullptr, 0)),
      draws_(make_buffer(GLsizeiptr{4} * LKAO_DRAW_WORD_COUNT, nullptr, GL_DYNAMIC_STORAGE_BIT)),
      triangles_texture_(make_buffer_texture(GL_RGB32UI, triangles_)),
      ranges_texture_(make_buffer_texture(GL_RG32F, ranges_)),
      frames_texture_(make_buffer_texture(GL_RGBA32F, frames_)),
      prisms_texture_(make_buffer_texture(GL_R32UI, prisms_)),
      billboards_texture_(make_buffer_texture(GL_R32UI, billboards_)),
      draws_texture_(make_buffer_texture(GL_R32UI, draws_)) {}

void TriangleBuffers::bind_triangles() const {
  glBindTextureUnit(LKAO_UNIT_TRIANGLES, triangles_texture_.name());
  glBindTextureUnit(LKAO_UNIT_RANGES, ranges_texture_.name());
}

void TriangleBuffers::classify(bool two_sided) const {
  const auto words = empty_draws(two_sided);
  glNamedBufferSubData(draws_.name(), 0, sizeof(words), words.data());
  bind_triangles();
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_DRAWS, draws_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_PRISMS, prisms_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_BILLBOARDS, billboards_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_FRAMES, frames_.name());
  // Rows of groups: no count may be larger than 65535.
  const std::size_t group_count = (count_ + LKAO_GROUP_SIZE - 1) / LKAO_GROUP_SIZE;
  const std::size_t columns = std::min<std::size_t>(group_count, 32768);
  glDispatchCompute(static_cast<GLuint>(columns), static_cast<GLuint>((group_count + columns - 1) / columns), 1);
}

void TriangleBuffers::bind(Shape shape) const {
  bind_triangles();
  glBindTextureUnit(LKAO_UNIT_FRAMES, frames_texture_.name());
  glBindTextureUnit(LKAO_UNIT_DRAWS, draws_texture_.name());
  glBindTextureUnit(LKAO_UNIT_LIST, (shape == Shape::prism ? prisms_texture_ : billboards_texture_).name());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, draws_.name());
}

void TriangleBuffers::draw_points(Shape shape) const {
  glDrawArraysIndirect(GL_POINTS, command(shape == Shape::prism ? LKAO_DRAW_PRISM_ARRAYS : LKAO_DRAW_BILLBOARD_ARRAYS));
}

void TriangleBuffers::draw_batches(Shape shape) const {
  glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT,
                         command(shape == Shape::prism ? LKAO_DRAW_PRISM_ELEMENTS : LKAO_DRAW_BILLBOARD_ELEMENTS));
}

}  // namespace lkao::gl
