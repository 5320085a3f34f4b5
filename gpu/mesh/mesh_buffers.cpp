#include "gpu/mesh/mesh_buffers.h"

#include <algorithm>
#include <atomic>
#include <stdexcept>

#include <fmt/format.h>

#include "gpu/gl/error.h"
#include "gpu/mesh/units.h"
#include "lut/mesh_views.h"

namespace lkao::gl {
namespace {

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

void require_opacities(std::span<const float> opacities, std::size_t triangle_count) {
  if (!opacities.empty() && opacities.size() != triangle_count) {
    throw std::invalid_argument(fmt::format("{} opacities for {} triangles", opacities.size(), triangle_count));
  }
  for (std::size_t i = 0; i < opacities.size(); ++i) {
    if (opacities[i] >= 0 && opacities[i] <= 1) continue;
    throw std::invalid_argument(fmt::format("opacities[{}] must be from 0 to 1, not {}", i, opacities[i]));
  }
}

std::size_t texture_buffer_size() {
  GLint texels = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
  return static_cast<std::size_t>(texels);
}

void require_room(std::size_t position_count) {
  if (position_count > texture_buffer_size()) {
    throw std::runtime_error(
        fmt::format("{} positions, and this OpenGL takes only {}", position_count, texture_buffer_size()));
  }
}

GLsizeiptr packed_size(const PositionView& positions) {
  return static_cast<GLsizeiptr>(positions.size() * sizeof(glm::vec3));
}

// Calls `take(data)` with the positions packed, as OpenGL takes them; copies only what is not.
template <typename Take>
void with_packed(const PositionView& positions, const Take& take) {
  if (positions.is_packed()) return take(positions.data());
  std::vector<glm::vec3> packed(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) packed[i] = positions[i];
  take(static_cast<const void*>(packed.data()));
}

std::vector<glm::uvec3> pack(const IndexView& triangles, std::size_t first, std::size_t count) {
  std::vector<glm::uvec3> packed(count);
  for (std::size_t i = 0; i < count; ++i) packed[i] = triangles[first + i];
  return packed;
}

template <typename Value>
Buffer make_buffer_of(std::span<const Value> values) {
  return make_buffer(static_cast<GLsizeiptr>(values.size_bytes()), values.data(), 0);
}

}  // namespace

std::size_t MeshBuffers::capacity() {
  GLint64 block_size = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block_size);
  return std::min(texture_buffer_size() / kMostTexels, static_cast<std::size_t>(block_size) / (16 * kMostTexels));
}

MeshBuffers::MeshBuffers(const PositionView& positions, const IndexView& triangles, std::span<const glm::vec2> ranges)
    : position_count_(positions.size()), has_ranges_(!ranges.empty()) {
  require_ranges(ranges, triangles.size());
  lut::check_indices(triangles, positions.size());
  require_room(positions.size());
  with_packed(positions, [&](const void* data) {
    positions_ = make_buffer(packed_size(positions), data, GL_DYNAMIC_STORAGE_BIT);
  });
  positions_texture_ = make_buffer_texture(GL_RGB32F, positions_);
  for (std::size_t first = 0; first < triangles.size(); first += capacity()) {
    const std::size_t count = std::min(capacity(), triangles.size() - first);
    parts_.push_back(make_part(pack(triangles, first, count), has_ranges_ ? ranges.subspan(first, count) : ranges));
  }
  check_errors("copying the occluders");
  note_change();
}

MeshBuffers::Part MeshBuffers::make_part(const std::vector<glm::uvec3>& triangles, std::span<const glm::vec2> ranges) {
  Part part{triangles.size(), make_buffer_of(std::span(triangles)), make_buffer_of(ranges), {}, {}, {}};
  part.triangles_texture = make_buffer_texture(GL_RGB32UI, part.triangles);
  part.ranges_texture = make_buffer_texture(GL_RG32F, part.ranges);
  return part;
}

void MeshBuffers::update_positions(const PositionView& positions) {
  if (positions.size() != position_count_) {
    throw std::invalid_argument(
        fmt::format("there are {} positions to update, not {}", position_count_, positions.size()));
  }
  if (positions.size() > 0) {
    with_packed(positions,
                [&](const void* data) { glNamedBufferSubData(positions_.name(), 0, packed_size(positions), data); });
  }
  check_errors("updating positions");
  note_change();
}

void MeshBuffers::set_opacities(std::span<const float> opacities) {
  require_opacities(opacities, triangle_count());
  has_opacities_ = !opacities.empty();
  for (Part& part : parts_) {
    const std::size_t count = has_opacities_ ? part.count : 0;
    part.opacities = has_opacities_ ? make_buffer_of(opacities.first(count)) : Buffer();
    opacities = opacities.subspan(count);
  }
  check_errors("copying opacities");
  note_change();
}

void MeshBuffers::note_change() {
  static std::atomic<std::uint64_t> last = 0;
  version_ = ++last;
}

std::size_t MeshBuffers::triangle_count() const {
  std::size_t count = 0;
  for (const Part& part : parts_) count += part.count;
  return count;
}

void MeshBuffers::bind_positions() const { glBindTextureUnit(LKAO_UNIT_POSITIONS, positions_texture_.name()); }

void MeshBuffers::bind_triangles(std::size_t part) const {
  glBindTextureUnit(LKAO_UNIT_TRIANGLES, parts_[part].triangles_texture.name());
  glBindTextureUnit(LKAO_UNIT_RANGES, parts_[part].ranges_texture.name());
}

void MeshBuffers::bind_opacities(std::size_t part) const {
  if (!has_opacities_) return;
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_OPACITIES, parts_[part].opacities.name());
}

}  // namespace lkao::gl
