#include "gpu/mesh/geometry_check.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/frame/view.h"
#include "gpu/gl/error.h"
#include "gpu/gl/uniform_buffer.h"
#include "gpu/mesh/shape_lists.h"
#include "gpu/mesh/shapes.h"

namespace lkao::gl {
namespace {

constexpr int kSize = 64;
constexpr GLsizeiptr kPixelCount = GLsizeiptr{kSize} * kSize;

// How often each pixel is drawn by the far side of a prism that the camera is inside of.
std::vector<std::uint32_t> count_prism(GeometryBackEnd back_end) {
  const Camera camera{glm::mat4(1), glm::perspective(1.0f, 1.0f, 0.1f, 10.0f), ClipDepth::minus_one_to_one};
  const Pixels pixels{kSize, kSize};
  const float radius = 1;
  const UniformBuffer<ViewBlock> view;
  const UniformBuffer<ShapesBlock> shapes;
  ShapesBlock shapes_block{};
  shapes_block.is_two_sided = 1;
  const ViewBlock view_block = make_view_block(camera, pixels);
  set_camera(camera, pixels, view_block, radius, shapes_block);
  // Not cleared by OpenGL: that would read the zero as the host's pixel store parameters say.
  const std::vector<std::uint32_t> zeros(kPixelCount);
  const Buffer counts = make_buffer(kPixelCount * 4, zeros.data(), 0);

  const glm::vec3 positions[] = {{-9, -8, -0.4f}, {8, -9, -0.6f}, {1, 9, -0.5f}};
  const glm::uvec3 triangle(0, 1, 2);
  const MeshBuffers mesh(positions, std::span(&triangle, 1), {});
  ShapeLists lists;
  const ShapePrograms programs = make_shape_programs(back_end, "mesh/coverage.frag", {});
  const ProgramObject classify = make_program({"mesh/classify.comp"});
  const Framebuffer framebuffer = make_framebuffer();
  glNamedFramebufferParameteri(framebuffer.name(), GL_FRAMEBUFFER_DEFAULT_WIDTH, kSize);
  glNamedFramebufferParameteri(framebuffer.name(), GL_FRAMEBUFFER_DEFAULT_HEIGHT, kSize);

  view.set_and_bind(view_block);
  shapes.set_and_bind(shapes_block);
  lists.classify(mesh, classify.name(), true);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  glViewportIndexedf(0, 0, 0, kSize, kSize);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, counts.name());
  glEnable(GL_DEPTH_CLAMP);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_FRONT);
  glFrontFace(GL_CCW);
  glUseProgram(programs.prism.name());
  lists.draw(mesh, Shape::prism, back_end);
  glDisable(GL_CULL_FACE);
  glDisable(GL_DEPTH_CLAMP);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<std::uint32_t> result(kPixelCount);
  glGetNamedBufferSubData(counts.name(), 0, kPixelCount * 4, result.data());
  check_errors("testing the geometry back end");
  return result;
}

}  // namespace

bool geometry_works(GeometryBackEnd back_end) {
  try {
    const std::vector<std::uint32_t> counts = count_prism(back_end);
    const auto once = std::count(counts.begin(), counts.end(), 1u),
               never = std::count(counts.begin(), counts.end(), 0u);
    // Twice costs time and no more, as it may along clipped edges.
    return never == 0 && once >= kPixelCount - kPixelCount / 50;
  } catch (const std::runtime_error&) {
    return false;
  }
}

GeometryBackEnd choose(GeometryBackEnd wanted) {
  if (wanted != GeometryBackEnd::automatic) return wanted;
  for (GeometryBackEnd back_end : {GeometryBackEnd::vertex_pulling, GeometryBackEnd::geometry_shader}) {
    if (geometry_works(back_end)) return back_end;
  }
  throw std::runtime_error("this OpenGL draws shapes without cracks by neither geometry back end");
}

}  // namespace lkao::gl
