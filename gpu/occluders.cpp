#include "gpu/occluders.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "gpu/gl_error.h"
#include "gpu/shaders/constants.h"

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

void require_indices(std::span<const glm::uvec3> triangles, std::size_t position_count) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      if (triangles[i][corner] < position_count) continue;
      throw std::invalid_argument(fmt::format("triangle {} has index {}, but there are only {} positions", i,
                                              triangles[i][corner], position_count));
    }
  }
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

}  // namespace

Occluders::Occluders()
    : largest_(make_buffer(4, nullptr, GL_DYNAMIC_STORAGE_BIT)),
      largest_texture_(make_buffer_texture(GL_R32F, largest_)),
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
  require_indices(triangles, positions.size());
  GLint texels = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
  if (positions.size() > static_cast<std::size_t>(texels)) {
    throw std::runtime_error(fmt::format("{} positions, and this OpenGL takes only {}", positions.size(), texels));
  }

  // None, should there be too little memory for them.
  position_count_ = 0;
  triangles_.clear();
  positions_ = make_buffer(static_cast<GLsizeiptr>(positions.size_bytes()), positions.data(), GL_DYNAMIC_STORAGE_BIT);
  positions_texture_ = make_buffer_texture(GL_RGB32F, positions_);
  has_ranges_ = !ranges.empty();
  std::vector<TriangleBuffers> all;
  const std::size_t capacity = TriangleBuffers::capacity();
  for (std::size_t first = 0; first < triangles.size(); first += capacity) {
    const std::size_t count = std::min(capacity, triangles.size() - first);
    all.emplace_back(triangles.subspan(first, count), has_ranges_ ? ranges.subspan(first, count) : ranges);
  }
  check_errors("copying the occluders");
  position_count_ = positions.size();
  triangles_ = std::move(all);
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

void Occluders::classify(GLuint program, bool two_sided) const {
  const GLuint zero = 0;
  glNamedBufferSubData(largest_.name(), 0, sizeof(zero), &zero);
  glBindTextureUnit(LKAO_UNIT_POSITIONS, positions_texture_.name());
  glBindTextureUnit(LKAO_UNIT_LARGEST, largest_texture_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_LARGEST, largest_.name());
  glUseProgram(program);
  for (const TriangleBuffers& triangles : triangles_) triangles.classify(two_sided);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void Occluders::draw(Shape shape, GeometryBackEnd back_end) const {
  const VertexArray& pulled = shape == Shape::prism ? pulled_prisms_ : pulled_billboards_;
  const bool is_pulled = back_end == GeometryBackEnd::vertex_pulling;
  glBindVertexArray((is_pulled ? pulled : no_attributes_).name());
  for (const TriangleBuffers& triangles : triangles_) {
    triangles.bind(shape);
    if (is_pulled) {
      triangles.draw_batches(shape);
    } else {
      triangles.draw_points(shape);
    }
  }
}

}  // namespace lkao::gl
