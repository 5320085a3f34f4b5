// How dark is the floor at the foot of a wall, in a frame of an engine?
#include <epoxy/gl.h>
#include <lkao/gl.h>

#include <array>
#include <cstdio>
#include <stdexcept>
#include <vector>

namespace {

constexpr int kSize = 16;

// A texture of the G-buffer, the same in every pixel.
GLuint make_texture(const std::array<float, 4>& value) {
  GLuint texture = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &texture);
  glTextureStorage2D(texture, 1, GL_RGBA32F, kSize, kSize);
  glClearTexImage(texture, 0, GL_RGBA, GL_FLOAT, value.data());
  return texture;
}

float draw() {
  // The floor lies at y = 0, the wall stands on it at z = 0.
  const std::array<glm::vec3, 8> positions{
      {{-5, 0, -5}, {5, 0, -5}, {5, 0, 5}, {-5, 0, 5}, {-5, 0, 0}, {5, 0, 0}, {5, 5, 0}, {-5, 5, 0}}};
  const std::array<glm::uvec3, 4> triangles{{{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}}};
  const GLuint foot = make_texture({0, 0, 0.001f, 1}), up = make_texture({0, 1, 0, 0});
  GLuint target = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &target);
  glTextureStorage2D(target, 1, GL_R32F, kSize, kSize);

  const lkao::gl::Occluders occluders(positions, triangles);
  // All pixels show one point, so it is not at theirs.
  lkao::gl::MaskPass pass({.check_g_buffer = false});
  pass.set_table(lkao::PlaneMaskTable(lkao::SamplePattern::standard(256), {.resolution = 64}));
  const lkao::gl::Camera camera{.view = glm::mat4(1), .projection = glm::mat4(1)};
  pass.draw(occluders, {.width = kSize, .height = kSize, .positions = foot, .normals = up}, camera, {.radius = 2.0f});
  pass.resolve({.occlusion = {target}});

  std::vector<float> pixels(std::size_t{kSize} * kSize);
  glGetTextureImage(target, 0, GL_RED, GL_FLOAT, static_cast<GLsizei>(pixels.size() * sizeof(float)), pixels.data());
  float sum = 0;
  for (const float pixel : pixels) sum += pixel;
  return sum / static_cast<float>(pixels.size());
}

}  // namespace

int main() {
  try {
    lkao::gl::HeadlessContext context(lkao::gl::Device::software);
    context.make_current();
    std::printf("occlusion at the foot of the wall: %.2f\n", draw());
  } catch (const std::runtime_error& error) {
    std::printf("Skipped: %s\n", error.what());
  }
}
