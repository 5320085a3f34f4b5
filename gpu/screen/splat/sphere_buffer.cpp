#include "gpu/screen/splat/sphere_buffer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <stdexcept>

#include "gpu/gl/error.h"
#include "gpu/screen/splat/units.h"

namespace lkao::gl {
namespace {

// Two triangles a sphere.
constexpr std::size_t kVertexCount = 6;
// What one call draws: vertices are numbered by an int.
constexpr std::size_t kSpheresPerDraw = std::size_t{1} << 28;

}  // namespace

SphereBuffer::SphereBuffer(bool counts) {
  if (counts) query_ = make_query(GL_SAMPLES_PASSED);
  make_room(0);
}

void SphereBuffer::make_room(std::size_t sphere_count) {
  buffer_ = make_buffer(static_cast<GLsizeiptr>(sphere_count * sizeof(glm::vec4)), nullptr, GL_DYNAMIC_STORAGE_BIT);
  texture_ = make_buffer_texture(GL_RGBA32F, buffer_);
  sphere_count_ = sphere_count;
}

void SphereBuffer::set(std::span<const glm::vec4> spheres) {
  GLint capacity = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &capacity);
  if (spheres.size() > static_cast<std::size_t>(capacity) || spheres.size() > kSpheresPerDraw) {
    throw std::runtime_error(fmt::format("{} spheres are more than this OpenGL takes ({})", spheres.size(), capacity));
  }
  if (spheres.size() != sphere_count_) make_room(spheres.size());
  if (!spheres.empty()) {
    glNamedBufferSubData(buffer_.name(), 0, static_cast<GLsizeiptr>(spheres.size_bytes()), spheres.data());
  }
  check_errors("setting spheres");
}

void SphereBuffer::draw(bool is_wanted) {
  if (query_) glBeginQuery(GL_SAMPLES_PASSED, query_.name());
  if (is_wanted && sphere_count_ > 0) {
    glBindTextureUnit(LKAO_UNIT_SPLAT_SPHERES, texture_.name());
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(kVertexCount * sphere_count_));
  }
  if (query_) glEndQuery(GL_SAMPLES_PASSED);
  is_drawn_ = true;
}

std::uint64_t SphereBuffer::read_fragment_count() const {
  if (!query_ || !is_drawn_) {
    throw std::runtime_error("read_fragment_count() needs SplatPassSetup::count_fragments and a draw()");
  }
  GLuint64 count = 0;
  glGetQueryObjectui64v(query_.name(), GL_QUERY_RESULT, &count);
  check_errors("reading how many fragments were drawn");
  return count;
}

}  // namespace lkao::gl
