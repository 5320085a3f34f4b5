// Contexts without a window, and the one feature of OpenGL that the mask passes stand on: GL_OR on integer targets.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <future>
#include <stdexcept>
#include <string>
#include <vector>

#include "gpu/on_software.h"
#include "lkao/gl.h"

namespace lkao::gl {
namespace {

using Pixel = std::array<std::uint32_t, 4>;
constexpr int kSize = 64;

class HeadlessContextOnSoftware : public tests::OnSoftware {};
class IntegerTarget : public tests::OnSoftware {};

// A framebuffer with one RGBA32UI texture, bound for drawing and reading.
class MaskTarget {
 public:
  MaskTarget() {
    glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
    glTextureStorage2D(texture_, 1, GL_RGBA32UI, kSize, kSize);
    glCreateFramebuffers(1, &framebuffer_);
    glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, texture_, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glViewport(0, 0, kSize, kSize);
  }
  ~MaskTarget() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteTextures(1, &texture_);
  }
  MaskTarget(const MaskTarget&) = delete;
  MaskTarget& operator=(const MaskTarget&) = delete;

  void clear(const Pixel& value) { glClearBufferuiv(GL_COLOR, 0, value.data()); }
  std::vector<Pixel> read() const {
    std::vector<Pixel> pixels(std::size_t{kSize} * kSize);
    glReadPixels(0, 0, kSize, kSize, GL_RGBA_INTEGER, GL_UNSIGNED_INT, pixels.data());
    return pixels;
  }

 private:
  GLuint texture_ = 0;
  GLuint framebuffer_ = 0;
};

GLuint compile(GLenum stage, const char* source) {
  const GLuint shader = glCreateShader(stage);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  EXPECT_EQ(compiled, GL_TRUE);
  return shader;
}

// Fills the scissor rectangle with the uniform `mask` at location 0.
GLuint make_fill_program() {
  const GLuint vertex = compile(GL_VERTEX_SHADER, R"(#version 450 core
    void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); })");
  const GLuint fragment = compile(GL_FRAGMENT_SHADER, R"(#version 450 core
    layout(location = 0) uniform uvec4 mask;
    layout(location = 0) out uvec4 result;
    void main() { result = mask; })");
  const GLuint program = glCreateProgram();
  for (GLuint shader : {vertex, fragment}) {
    glAttachShader(program, shader);
    glDeleteShader(shader);
  }
  glLinkProgram(program);
  return program;
}

struct Rectangle {
  int x, y, width, height;
  Pixel mask;
};

// Overlapping rectangles whose masks have bits in every byte, the sign bits among them.
std::vector<Rectangle> make_rectangles() {
  std::vector<Rectangle> rectangles;
  std::uint32_t state = 1;
  const auto next = [&state] { return state = state * 1664525u + 1013904223u; };
  for (int i = 0; i < 200; ++i) {
    Rectangle r{static_cast<int>(next() >> 26),
                static_cast<int>(next() >> 26),
                1 + static_cast<int>(next() >> 27),
                1 + static_cast<int>(next() >> 27),
                {}};
    for (std::uint32_t& word : r.mask) word = next() & next() & next() & next();
    rectangles.push_back(r);
  }
  return rectangles;
}

std::vector<Pixel> or_on_cpu(const std::vector<Rectangle>& rectangles, const Pixel& background) {
  std::vector<Pixel> pixels(std::size_t{kSize} * kSize, background);
  for (const Rectangle& r : rectangles) {
    for (int y = r.y; y < std::min(r.y + r.height, kSize); ++y) {
      for (int x = r.x; x < std::min(r.x + r.width, kSize); ++x) {
        for (std::size_t word = 0; word < 4; ++word)
          pixels[static_cast<std::size_t>(y * kSize + x)][word] |= r.mask[word];
      }
    }
  }
  return pixels;
}

TEST_F(HeadlessContextOnSoftware, IsOpenGl45Core) {
  EXPECT_EQ(context_->is_software(), tests::tested_device() == Device::software);
  EXPECT_FALSE(context_->renderer().empty());
  GLint major = 0, minor = 0, profile = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  EXPECT_GE(major * 10 + minor, 45) << context_->version();
  EXPECT_NE(profile & GL_CONTEXT_CORE_PROFILE_BIT, 0);
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST(HeadlessContext, HardwareIsAGpuOrOneLineThatSaysThereIsNone) {
  try {
    const HeadlessContext context(Device::hardware);
    EXPECT_FALSE(context.is_software()) << context.renderer();
  } catch (const std::runtime_error& error) {
    const std::string line = error.what();
    EXPECT_NE(line.find("hardware"), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
}

TEST_F(HeadlessContextOnSoftware, ConstructionKeepsTheCurrentContext) {
  MaskTarget target;
  target.clear({1, 2, 3, 4});
  const HeadlessContext second(tests::tested_device());
  EXPECT_EQ(target.read().front(), (Pixel{1, 2, 3, 4}));
}

TEST_F(HeadlessContextOnSoftware, ContextsAreIndependent) {
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  EXPECT_TRUE(glIsTexture(texture));
  {
    HeadlessContext second(tests::tested_device());
    second.make_current();
    EXPECT_FALSE(glIsTexture(texture)) << "the second context sees the first one's objects";
  }
  // The second is gone, and the first still works.
  context_->make_current();
  EXPECT_TRUE(glIsTexture(texture));
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(HeadlessContextOnSoftware, IsCurrentInOneThreadAtATime) {
  const auto make_current_elsewhere = [this] {
    context_->make_current();
    context_->release();
  };
  EXPECT_THROW(std::async(std::launch::async, make_current_elsewhere).get(), std::runtime_error);
  context_->release();
  EXPECT_NO_THROW(std::async(std::launch::async, make_current_elsewhere).get());
}

TEST_F(IntegerTarget, ReadsBackWhatItWasClearedTo) {
  MaskTarget target;
  ASSERT_EQ(glCheckFramebufferStatus(GL_FRAMEBUFFER), static_cast<GLenum>(GL_FRAMEBUFFER_COMPLETE));
  const Pixel value{0x80000001u, 0xffffffffu, 0u, 0x12345678u};
  target.clear(value);
  EXPECT_EQ(target.read(), std::vector<Pixel>(std::size_t{kSize} * kSize, value));
}

TEST_F(IntegerTarget, LogicOpGathersMasksByOr) {
  MaskTarget target;
  const Pixel background{0u, 1u, 0x80000000u, 0u};
  target.clear(background);
  const GLuint program = make_fill_program();
  GLuint vertex_array = 0;
  glCreateVertexArrays(1, &vertex_array);
  glBindVertexArray(vertex_array);
  glUseProgram(program);
  glEnable(GL_SCISSOR_TEST);
  glEnable(GL_COLOR_LOGIC_OP);
  glLogicOp(GL_OR);

  const std::vector<Rectangle> rectangles = make_rectangles();
  for (const Rectangle& r : rectangles) {
    glScissor(r.x, r.y, r.width, r.height);
    glUniform4ui(0, r.mask[0], r.mask[1], r.mask[2], r.mask[3]);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  ASSERT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
  EXPECT_EQ(target.read(), or_on_cpu(rectangles, background));
  glDeleteVertexArrays(1, &vertex_array);
  glDeleteProgram(program);
}

}  // namespace
}  // namespace lkao::gl
