// The rasterised method on what a camera of the program sees: a context, a view, a pass, and the time of its frames.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lkao/gl.h"
#include "raster/view_textures.h"
#include "scene/camera.h"
#include "scene/mesh.h"

namespace lkao::raster {

// Draws the pixels of a view; pixel (row * width + column) casts the rays that AmbientOcclusion casts for the receiver
// of that index. In any order: set_view() and start_pass(), as often as wanted; then draw(), as often as wanted.
//
// A thread has one at a time, and every member is called in that thread: the constructor leaves its context current
// there. Errors of OpenGL throw std::runtime_error, wrong arguments std::invalid_argument, with one line.
class Rasterizer {
 public:
  // Throws std::runtime_error where EGL offers no such device.
  explicit Rasterizer(gl::Device device = gl::Device::automatic);

  const gl::HeadlessContext& context() const { return *context_; }

  // Throws std::runtime_error where the device cannot draw so large an image.
  void require_size(int width, int height) const;

  void set_view(const scene::Camera& camera, const scene::ReceiverImage& image);
  // A new pass in place of the old one; `ranges` as Occluders takes them.
  void start_pass(const gl::MaskPassSetup& setup, const scene::Mesh& mesh, const PlaneMaskTable& table,
                  std::span<const glm::vec2> ranges = {});
  // To change its table, and to read what the last frame left: masks, fragment counts. Needs start_pass().
  gl::MaskPass& pass();

  // A frame with next to nothing to draw, so that what a driver leaves to the first one, such as compiling shaders, is
  // done.
  void warm_up(const RayOptions& options, const gl::RasterOptions& raster = {});

  // One frame, masks and resolve, with nothing else under way; returns its seconds.
  double draw(const RayOptions& options, const gl::RasterOptions& raster = {}, bool with_bent_normals = false);

  // Of the last frame, one a pixel, row by row from the top; NaN where there is no receiver, or one that casts no ray.
  std::vector<float> read_occlusion() const;
  std::vector<glm::vec3> read_bent_normals() const;  // where it was drawn with them

 private:
  std::unique_ptr<gl::HeadlessContext> context_;  // first: it outlives what is in it
  gl::Camera camera_;
  std::optional<ViewTextures> textures_;
  std::optional<gl::Occluders> occluders_;
  std::optional<gl::MaskPass> pass_;
  enum class Drawn { nothing, occlusion, bent_normals_too } drawn_ = Drawn::nothing;
};

}  // namespace lkao::raster
