// The textures of one view: its G-buffer, and what a frame is resolved to.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "gpu/gl/objects.h"
#include "lkao/gl.h"
#include "scene/camera.h"

namespace lkao::raster {

// Throws std::runtime_error with one line where the current context has no textures of that size.
void require_texture_size(int width, int height);

// Of the context that is current when it is made. All floats are of 32 bits, so that the pass gets the very receivers
// that the CPU's query gets.
class ViewTextures {
 public:
  // Throws std::runtime_error with one line where the image is too large.
  explicit ViewTextures(const scene::ReceiverImage& image);

  gl::GBuffer g_buffer() const;
  gl::ResolveTargets targets(bool with_bent_normals);

  // One a pixel, row by row from the top. NaN where there is no receiver, or one that casts no ray.
  std::vector<float> read_occlusion() const;
  // As above; needs targets(true).
  std::vector<glm::vec3> read_bent_normals() const;

 private:
  int width_;
  int height_;
  gl::Texture positions_;
  gl::Texture normals_;
  gl::Texture geometric_normals_;  // none where all receivers go by their normals
  gl::Texture occlusion_;
  gl::Texture bent_normals_;  // made when first asked for
};

}  // namespace lkao::raster
