#include "gpu/self_test.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/gl_error.h"
#include "gpu/occluders.h"
#include "gpu/shapes.h"
#include "gpu/targets.h"
#include "gpu/view.h"

namespace lkao::gl {
namespace {

constexpr int kSize = 64;
constexpr GLsizeiptr kPixelCount = GLsizeiptr{kSize} * kSize;
using Mask = std::array<std::uint32_t, 4>;

struct Rectangle {
  int x, y, width, height;
  Mask mask;
};

// With bits in every byte, the sign bits among them.
std::vector<Rectangle> overlapping_rectangles() {
  std::vector<Rectangle> rectangles;
  std::uint32_t state = 1;
  const auto next = [&state] { return state = state * 1664525u + 1013904223u; };
  for (int i = 0; i < 48; ++i) {
    Rectangle r{};
    r.x = static_cast<int>(next() >> 26);
    r.y = static_cast<int>(next() >> 26);
    r.width = 1 + static_cast<int>(next() >> 27);
    r.height = 1 + static_cast<int>(next() >> 27);
    for (std::uint32_t& word : r.mask) word = next() & next() & next();
    rectangles.push_back(r);
  }
  return rectangles;
}

std::vector<Mask> draw_on_cpu(const std::vector<Rectangle>& rectangles) {
  std::vector<Mask> pixels(kPixelCount);
  for (const Rectangle& r : rectangles) {
    for (int y = r.y; y < std::min(r.y + r.height, kSize); ++y) {
      for (int x = r.x; x < std::min(r.x + r.width, kSize); ++x) {
        Mask& pixel = pixels[static_cast<std::size_t>(y * kSize + x)];
        for (std::size_t word = 0; word < 4; ++word) pixel[word] |= r.mask[word];
      }
    }
  }
  return pixels;
}

std::vector<Mask> draw_by_logic_op(const std::vector<Rectangle>& rectangles) {
  const Targets targets(kSize, kSize, 1, false);
  const ProgramObject program = make_program({"screen.vert", "fill.frag"});
  const VertexArray no_attributes = make_vertex_array();
  targets.bind_masks();
  glUseProgram(program.name());
  glBindVertexArray(no_attributes.name());
  glEnable(GL_COLOR_LOGIC_OP);
  glLogicOp(GL_OR);
  for (const Rectangle& r : rectangles) {
    glViewportIndexedf(0, static_cast<float>(r.x), static_cast<float>(r.y), static_cast<float>(r.width),
                       static_cast<float>(r.height));
    glUniform4ui(0, r.mask[0], r.mask[1], r.mask[2], r.mask[3]);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  glDisable(GL_COLOR_LOGIC_OP);
  std::vector<Mask> pixels(kPixelCount);
  glGetTextureImage(targets.masks(), 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, GLsizei{kPixelCount * 16}, pixels.data());
  check_errors("testing the logic op");
  return pixels;
}

// How often each pixel is drawn by the far side of a prism that the camera is inside of.
std::vector<std::uint32_t> count_prism(GeometryBackEnd back_end) {
  const Camera camera{glm::mat4(1), glm::perspective(1.0f, 1.0f, 0.1f, 10.0f), ClipDepth::minus_one_to_one};
  const float radius = 1;
  PassUniforms uniforms;
  uniforms.flags.x = LKAO_FLAG_TWO_SIDED;
  uniforms.extent = {kSize, kSize, 0, 0};
  uniforms.lengths = {radius, 0, 0, 0};
  set_view(camera, kSize, kSize, radius, uniforms);
  const Buffer uniform_buffer = make_buffer(sizeof(uniforms), &uniforms, 0);
  const Buffer counts = make_buffer(kPixelCount * 4, nullptr, 0);
  const GLuint zero = 0;
  glClearNamedBufferData(counts.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);

  Occluders occluders;
  const glm::vec3 positions[] = {{-9, -8, -0.4f}, {8, -9, -0.6f}, {1, 9, -0.5f}};
  const glm::uvec3 triangle(0, 1, 2);
  occluders.set(positions, {&triangle, 1});
  const ShapePrograms programs = make_shape_programs(back_end, "coverage.frag", {});
  const ProgramObject classify = make_program({"classify.comp"});
  const Framebuffer framebuffer = make_framebuffer();
  glNamedFramebufferParameteri(framebuffer.name(), GL_FRAMEBUFFER_DEFAULT_WIDTH, kSize);
  glNamedFramebufferParameteri(framebuffer.name(), GL_FRAMEBUFFER_DEFAULT_HEIGHT, kSize);

  glBindBufferBase(GL_UNIFORM_BUFFER, 0, uniform_buffer.name());
  occluders.classify(classify.name(), true);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  glViewportIndexedf(0, 0, 0, kSize, kSize);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LKAO_STORAGE_MASKS, counts.name());
  glEnable(GL_DEPTH_CLAMP);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_FRONT);
  glFrontFace(GL_CCW);
  glUseProgram(programs.prism.name());
  occluders.draw(Shape::prism, back_end);
  glDisable(GL_CULL_FACE);
  glDisable(GL_DEPTH_CLAMP);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<std::uint32_t> result(kPixelCount);
  glGetNamedBufferSubData(counts.name(), 0, kPixelCount * 4, result.data());
  check_errors("testing the geometry back end");
  return result;
}

}  // namespace

bool logic_op_works() {
  const std::vector<Rectangle> rectangles = overlapping_rectangles();
  try {
    return draw_by_logic_op(rectangles) == draw_on_cpu(rectangles);
  } catch (const std::runtime_error&) {
    return false;
  }
}

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

Accumulator choose(Accumulator wanted) {
  if (wanted != Accumulator::automatic) return wanted;
  return logic_op_works() ? Accumulator::logic_op : Accumulator::ssbo;
}

GeometryBackEnd choose(GeometryBackEnd wanted) {
  if (wanted != GeometryBackEnd::automatic) return wanted;
  for (GeometryBackEnd back_end : {GeometryBackEnd::vertex_pulling, GeometryBackEnd::geometry_shader}) {
    if (geometry_works(back_end)) return back_end;
  }
  throw std::runtime_error("this OpenGL passes the self-test of neither geometry back end");
}

}  // namespace lkao::gl
