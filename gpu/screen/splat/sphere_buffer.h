// The spheres of the far half on the GPU, and how they are drawn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/vec4.hpp>

#include "gpu/gl/objects.h"
#include "lkao/gl/frame.h"

namespace lkao::gl {

class SphereBuffer {
 public:
  // `counts`: the fragments of each frame.
  explicit SphereBuffer(bool counts);

  // As SplatPass has them.
  void set(std::span<const glm::vec4> spheres);
  ObjectName name() const { return buffer_.name(); }

  // Binds the spheres and draws a rectangle for each, or none where `is_wanted` is false. Needs program, vertex array
  // and framebuffer.
  void draw(bool is_wanted);
  // Of the last draw(). Throws std::runtime_error where nothing was counted.
  std::uint64_t read_fragment_count() const;

 private:
  void make_room(std::size_t sphere_count);

  std::size_t sphere_count_ = 0;
  Buffer buffer_;
  Texture texture_;
  Query query_;  // none: nothing is counted
  bool is_drawn_ = false;
};

}  // namespace lkao::gl
