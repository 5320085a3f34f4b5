// A mesh on the GPU: one buffer of positions, and as many of triangles as it fills.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "gpu/gl/objects.h"
#include "lkao/gl/frame.h"
#include "lkao/index_view.h"
#include "lkao/position_view.h"

namespace lkao::gl {

// What a frame finds out about a triangle (LKAO_UNIT_FRAMES), in vectors of four floats.
inline constexpr std::size_t kFrameTexels = 2;
// The largest of the buffers that there are for each triangle, in such vectors.
inline constexpr std::size_t kMostTexels = 3;

class MeshBuffers {
 public:
  // How many triangles this driver's buffers take, with what passes find out about each.
  static std::size_t capacity();

  // As Occluders says it.
  MeshBuffers(const PositionView& positions, const IndexView& triangles, std::span<const glm::vec2> ranges);

  void update_positions(const PositionView& positions);
  ObjectName positions_buffer() const { return positions_.name(); }
  // As Occluders says it.
  void set_opacities(std::span<const float> opacities);
  // To be called where somebody else has changed the positions.
  void note_change();
  // Another number for every mesh, and after every change of it that this side knows of.
  std::uint64_t version() const { return version_; }

  bool has_ranges() const { return has_ranges_; }
  bool has_opacities() const { return has_opacities_; }
  std::size_t part_count() const { return parts_.size(); }
  std::size_t triangle_count(std::size_t part) const { return parts_[part].count; }
  std::size_t triangle_count() const;

  // For shaders: the positions, and the triangles of a part with their ranges.
  void bind_positions() const;
  void bind_triangles(std::size_t part) const;
  // For classify.comp: where there are some.
  void bind_opacities(std::size_t part) const;

 private:
  struct Part {
    std::size_t count;
    Buffer triangles, ranges, opacities;
    Texture triangles_texture, ranges_texture;
  };
  static Part make_part(const std::vector<glm::uvec3>& triangles, std::span<const glm::vec2> ranges);

  std::size_t position_count_;
  bool has_ranges_;
  bool has_opacities_ = false;
  std::uint64_t version_ = 0;
  Buffer positions_;
  Texture positions_texture_;
  std::vector<Part> parts_;
};

}  // namespace lkao::gl
