#include "gpu/masks/logic_op_check.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "gpu/gl/error.h"
#include "gpu/gl/program.h"
#include "gpu/masks/mask_images.h"

namespace lkao::gl {
namespace {

constexpr int kDrawnSize = 64;
constexpr GLsizeiptr kDrawnCount = GLsizeiptr{kDrawnSize} * kDrawnSize;
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
  std::vector<Mask> pixels(kDrawnCount);
  for (const Rectangle& r : rectangles) {
    for (int y = r.y; y < std::min(r.y + r.height, kDrawnSize); ++y) {
      for (int x = r.x; x < std::min(r.x + r.width, kDrawnSize); ++x) {
        Mask& pixel = pixels[static_cast<std::size_t>(y * kDrawnSize + x)];
        for (std::size_t word = 0; word < 4; ++word) pixel[word] |= r.mask[word];
      }
    }
  }
  return pixels;
}

std::vector<Mask> draw_by_logic_op(const std::vector<Rectangle>& rectangles) {
  MaskImages images;
  images.make_room(kDrawnSize, kDrawnSize, 1, false);
  const ProgramObject program = make_program({"frame/screen.vert", "masks/fill.frag"});
  const VertexArray no_attributes = make_vertex_array();
  images.bind_masks();
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
  std::vector<Mask> pixels(kDrawnCount);
  glGetTextureImage(images.masks(), 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, GLsizei{kDrawnCount * 16}, pixels.data());
  check_errors("testing the logic op");
  return pixels;
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

Accumulator choose(Accumulator wanted) {
  if (wanted != Accumulator::automatic) return wanted;
  return logic_op_works() ? Accumulator::logic_op : Accumulator::ssbo;
}

}  // namespace lkao::gl
