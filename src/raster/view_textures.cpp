#include "raster/view_textures.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/vec4.hpp>

#include "gpu/gl/error.h"

namespace lkao::raster {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
// No occlusion is negative; shaders need not keep NaN.
constexpr float kNoReceiver = -1;

gl::Texture make_image(GLenum format, int width, int height) {
  gl::Texture texture = gl::make_texture(GL_TEXTURE_2D);
  glTextureStorage2D(texture.name(), 1, format, width, height);
  gl::check_errors("making the textures of a view");
  return texture;
}

// A texture of one vector of every receiver.
gl::Texture make_vectors(const scene::ReceiverImage& image, glm::vec3 Receiver::*vector) {
  std::vector<glm::vec3> texels;
  texels.reserve(image.receivers.size());
  for (const Receiver& receiver : image.receivers) texels.push_back(receiver.*vector);
  gl::Texture texture = make_image(GL_RGBA32F, image.width, image.height);
  glTextureSubImage2D(texture.name(), 0, 0, 0, image.width, image.height, GL_RGB, GL_FLOAT, texels.data());
  gl::check_errors("filling the textures of a view");
  return texture;
}

bool has_geometric_normals(const scene::ReceiverImage& image) {
  return std::any_of(image.receivers.begin(), image.receivers.end(),
                     [](const Receiver& receiver) { return receiver.geometric_normal != glm::vec3(0); });
}

template <typename Texel>
std::vector<Texel> read(const gl::Texture& texture, GLenum format, int width, int height) {
  std::vector<Texel> texels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  glGetTextureSubImage(texture.name(), 0, 0, 0, 0, width, height, 1, format, GL_FLOAT,
                       static_cast<GLsizei>(texels.size() * sizeof(Texel)), texels.data());
  gl::check_errors("reading a frame");
  return texels;
}

}  // namespace

void require_texture_size(int width, int height) {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (width <= largest && height <= largest) return;
  throw std::runtime_error(
      fmt::format("{}x{} pixels are more than this OpenGL can draw ({} a side)", width, height, largest));
}

ViewTextures::ViewTextures(const scene::ReceiverImage& image) : width_(image.width), height_(image.height) {
  require_texture_size(width_, height_);
  positions_ = make_vectors(image, &Receiver::position);
  normals_ = make_vectors(image, &Receiver::normal);
  if (has_geometric_normals(image)) geometric_normals_ = make_vectors(image, &Receiver::geometric_normal);
  occlusion_ = make_image(GL_R32F, width_, height_);
}

gl::GBuffer ViewTextures::g_buffer() const {
  return {.width = width_,
          .height = height_,
          .positions = positions_.name(),
          .normals = normals_.name(),
          .geometric_normals = geometric_normals_.name()};
}

gl::ResolveTargets ViewTextures::targets(bool with_bent_normals) {
  if (with_bent_normals && !bent_normals_) bent_normals_ = make_image(GL_RGBA32F, width_, height_);
  return {.occlusion = {occlusion_.name(), kNoReceiver}, .bent_normals = with_bent_normals ? bent_normals_.name() : 0};
}

std::vector<float> ViewTextures::read_occlusion() const {
  std::vector<float> occlusion = read<float>(occlusion_, GL_RED, width_, height_);
  std::replace(occlusion.begin(), occlusion.end(), kNoReceiver, kNaN);
  return occlusion;
}

std::vector<glm::vec3> ViewTextures::read_bent_normals() const {
  const std::vector<glm::vec4> texels = read<glm::vec4>(bent_normals_, GL_RGBA, width_, height_);
  std::vector<glm::vec3> bent_normals;
  bent_normals.reserve(texels.size());
  for (const glm::vec4& texel : texels) bent_normals.push_back(texel.w > 0 ? glm::vec3(texel) : glm::vec3(kNaN));
  return bent_normals;
}

}  // namespace lkao::raster
