#include "gpu/occluders.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "gpu/gl_error.h"
#include "gpu/shaders/constants.h"

namespace lkao::gl {
namespace {

constexpr int kStripTriangles = LKAO_SHAPE_VERTEX_COUNT - 2;
using Strip = std::array<int, LKAO_SHAPE_VERTEX_COUNT>;
// As in prism.glsl and billboard.glsl.
constexpr Strip kPrismStrips[2] = {{6, 7, 11, 8, 10, 9, 4, 3, 5, 2, 0, 1}, {10, 4, 11, 5, 6, 0, 7, 1, 8, 2, 9, 3}};
constexpr Strip kPolygonStrip = {0, 1, 11, 2, 10, 3, 9, 4, 8, 5, 7, 6};
constexpr int kBillboardIndexCount = LKAO_BATCH_SIZE * kStripTriangles * 3;  // of one polygon each

void add_strip(const Strip& strip, int first_vertex, std::vector<std::uint16_t>& indices) {
  for (std::size_t i = 0; i + 2 < strip.size(); ++i) {
    // Every second triangle of a strip runs the other way round.
    const std::size_t second = i % 2 == 0 ? i + 1 : i + 2, third = i % 2 == 0 ? i + 2 : i + 1;
    for (std::size_t corner : {i, second, third}) {
      indices.push_back(static_cast<std::uint16_t>(first_vertex + strip[corner]));
    }
  }
}

std::vector<std::uint16_t> prism_indices() {
  std::vector<std::uint16_t> indices;
  for (int i = 0; i < LKAO_BATCH_SIZE; ++i) {
    for (const Strip& strip : kPrismStrips) add_strip(strip, i * LKAO_SHAPE_VERTEX_COUNT, indices);
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
std::array<std::uint32_t, LKAO_DRAW_WORD_COUNT> empty_draws(bool two_sided) {
  std::array<std::uint32_t, LKAO_DRAW_WORD_COUNT> words{};
  words[LKAO_DRAW_PRISM_ARRAYS + 1] = 1;
  words[LKAO_DRAW_BILLBOARD_ARRAYS + 1] = 1;
  words[LKAO_DRAW_PRISM_ELEMENTS] = LKAO_BATCH_SIZE * 2 * kStripTriangles * 3;
  words[LKAO_DRAW_BILLBOARD_ELEMENTS] = kBillboardIndexCount * (two_sided ? 1u : 2u);
  return words;
}

void require_limit(const char* what, std::size_t count, std::size_t limit) {
  if (count > limit) throw std::runtime_error(fmt::format("{} {}, and this OpenGL takes only {}", count, what, limit));
}

void require_ranges(std::span<const glm::vec2> ranges, std::size_t triangle_count) {
  if (!ranges.empty() && ranges.size() != triangle_count) {
    throw std::invalid_argument(fmt::format("{} ranges for {} triangles", ranges.size(), triangle_count));
  }
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (ranges[i].x >= 0 && ranges[i].x < ranges[i].y) continue;
    throw std::invalid_argument(
        fmt::format("ranges[{}] must have 0 <= r_min < r_max, not {} and {}", i, ranges[i].x, ranges[i].y));
  }
}

template <typename Value>
Buffer make_buffer_of(std::span<const Value> values, GLbitfield flags) {
  return make_buffer(static_cast<GLsizeiptr>(values.size_bytes()), values.data(), flags);
}

}  // namespace

Occluders::Occluders()
    : draws_(make_buffer(GLsizeiptr{4} * LKAO_DRAW_WORD_COUNT, nullptr, GL_DYNAMIC_STORAGE_BIT)),
      draws_texture_(make_buffer_texture(GL_R32UI, draws_)),
      prism_indices_(make_index_buffer(prism_indices())),
      billboard_indices_(make_index_buffer(billboard_indices())),
      no_attributes_(make_vertex_array()),
      pulled_prisms_(make_indexed(prism_indices_)),
      pulled_billboards_(make_indexed(billboard_indices_)) {
  set({}, {}, {});
}

void Occluders::set(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                    std::span<const glm::vec2> ranges) {
  require_ranges(ranges, triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      if (triangles[i][corner] >= positions.size()) {
        throw std::invalid_argument(fmt::format("triangle {} has index {}, but there are only {} positions", i,
                                                triangles[i][corner], positions.size()));
      }
    }
  }
  GLint texels = 0;
  GLint64 block_size = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block_size);
  require_limit("positions", positions.size(), static_cast<std::size_t>(texels));
  // The frames are the largest: two vectors of four floats each.
  require_limit("triangles", triangles.size(),
                std::min(static_cast<std::size_t>(texels) / 2, static_cast<std::size_t>(block_size) / 32));

  // None, should there be too little memory for them.
  position_count_ = triangle_count_ = 0;
  const auto count = static_cast<GLsizeiptr>(triangles.size());
  positions_ = make_buffer_of(positions, GL_DYNAMIC_STORAGE_BIT);
  triangles_ = make_buffer_of(triangles, 0);
  has_ranges_ = !ranges.empty();
  ranges_ = make_buffer_of(ranges, 0);
  frames_ = make_buffer(count * 32, nullptr, 0);
  prisms_ = make_buffer(count * 4, nullptr, 0);
  billboards_ = make_buffer(count * 4, nullptr, 0);
  positions_texture_ = make_buffer_texture(GL_RGB32F, positions_);
  triangles_texture_ = make_buffer_texture(GL_RGB32UI, triangles_);
  ranges_texture_ = make_buffer_texture(GL_RG32F, ranges_);
  frames_texture_ = make_buffer_texture(GL_RGBA32F, frames_);
  prisms_texture_ = make_buffer_texture(GL_R32UI, prisms_);
  billboards_texture_ = make_buffer_texture(GL_R32UI, billboards_);
  check_errors("copying the occluders");
  position_count_ = positions.size();
  triangle_count_ = triangles.size();
}

void Occluders::update(std::span<const glm::vec3> positions) {
  if (positions.size() != position_count_) {
    throw std::invalid_argument(
        fmt::format("there are {} positions to update, not {}", position_count_, positions.size()));
  }
  if (!positions.empty()) {
    glNamedBufferSubData(positions_.name(), 0, static_cast<GLsizeiptr>(positions.size_bytes()), positions.data());
  }
  check_errors("updating positions");
}

void Occluders::bind() const {
  glBindTextureUnit(LKAO_UNIT_POSITIONS, positions_texture_.name());
  glBindTextureUnit(LKAO_UNIT_TRIANGLES, triangles_texture_.name());
  glBindTextureUnit(LKAO_UNIT_RANGES, ranges_texture_.name());
  glBindTextureUnit(LKAO_UNIT_FRAMES, frames_texture_.name());
  glBindTextureUnit(LKAO_UNIT_DRAWS, draws_texture_.name());
}

void Occluders::classify(GLuint program, bool two_sided) const {
  const auto words = empty_draws(two_sided);
  glNamedBufferSubData(draws_.name(), 0, sizeof(words), words.data());
  bind();
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_DRAWS, draws_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_PRISMS, prisms_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_BILLBOARDS, billboards_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_FRAMES, frames_.name());
  if (triangle_count_ == 0) return;
  glUseProgram(program);
  // Rows of groups: no count may be larger than 65535.
  const std::size_t group_count = (triangle_count_ + LKAO_GROUP_SIZE - 1) / LKAO_GROUP_SIZE;
  const std::size_t columns = std::min<std::size_t>(group_count, 32768);
  glDispatchCompute(static_cast<GLuint>(columns), static_cast<GLuint>((group_count + columns - 1) / columns), 1);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void Occluders::draw_prisms(GeometryBackEnd back_end) const {
  draw(back_end, prisms_texture_, LKAO_DRAW_PRISM_ARRAYS, LKAO_DRAW_PRISM_ELEMENTS, pulled_prisms_);
}

void Occluders::draw_billboards(GeometryBackEnd back_end) const {
  draw(back_end, billboards_texture_, LKAO_DRAW_BILLBOARD_ARRAYS, LKAO_DRAW_BILLBOARD_ELEMENTS, pulled_billboards_);
}

void Occluders::draw(GeometryBackEnd back_end, const Texture& list, int arrays_word, int elements_word,
                     const VertexArray& pulled) const {
  if (triangle_count_ == 0) return;
  glBindTextureUnit(LKAO_UNIT_LIST, list.name());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, draws_.name());
  // Where a command starts in the buffer, as OpenGL wants to be told: by a pointer.
  const auto command = [](int word) { return std::bit_cast<const void*>(static_cast<std::uintptr_t>(word) * 4); };
  if (back_end == GeometryBackEnd::geometry_shader) {
    glBindVertexArray(no_attributes_.name());
    glDrawArraysIndirect(GL_POINTS, command(arrays_word));
  } else {
    glBindVertexArray(pulled.name());
    glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, command(elements_word));
  }
}

}  // namespace lkao::gl
