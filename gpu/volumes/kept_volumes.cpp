#include "gpu/volumes/kept_volumes.h"

#include "gpu/gl/error.h"
#include "gpu/mesh/dispatch.h"
#include "gpu/volumes/units.h"

namespace lkao::gl {

static_assert(LKAO_BASE_TEXELS <= kMostTexels);

KeptVolumes::Part::Part(std::size_t triangle_count)
    : capacity(triangle_count),
      bases(make_buffer(static_cast<GLsizeiptr>(capacity * 16 * LKAO_BASE_TEXELS), nullptr, 0)),
      texture(make_buffer_texture(GL_RGBA32F, bases)) {}

void KeptVolumes::find(const Key& key, const MeshBuffers& mesh, const ShapeLists& lists, GLuint program) {
  key_.reset();
  mesh.bind_positions();
  glUseProgram(program);
  for (std::size_t i = 0; i < mesh.part_count(); ++i) {
    const std::size_t count = mesh.triangle_count(i);
    if (i == parts_.size()) parts_.emplace_back(count);
    if (parts_[i].capacity < count) parts_[i] = Part(count);
    mesh.bind_triangles(i);
    lists.bind_frames(i);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_BASES, parts_[i].bases.name());
    dispatch_for_each(count);
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  check_errors("finding volumes");
  key_ = key;
}

void KeptVolumes::bind(std::size_t part) const { glBindTextureUnit(LKAO_UNIT_BASES, parts_[part].texture.name()); }

}  // namespace lkao::gl
