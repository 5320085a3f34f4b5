// Points in arrays of any layout.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstring>
#include <span>

#include <glm/vec3.hpp>

namespace lkao {

// A view of points that somebody else keeps; owns nothing and copies nothing. Three floats a point, at any alignment
// and any distance: interleaved with other data of a vertex, padded to four floats, or packed.
class PositionView {
 public:
  PositionView() = default;

  // Of vectors, arrays and spans of glm::vec3.
  template <std::convertible_to<std::span<const glm::vec3>> Positions>
  PositionView(const Positions& positions) : PositionView(std::span<const glm::vec3>(positions)) {}
  PositionView(std::span<const glm::vec3> positions)
      : first_(reinterpret_cast<const std::byte*>(positions.data())),
        count_(positions.size()),
        stride_(sizeof(glm::vec3)) {}

  // `first` is the x of point 0; each point begins `stride` bytes after the one before; 0: packed. Throws
  // std::invalid_argument where points would overlap.
  PositionView(const float* first, std::size_t count, std::size_t stride = 0);

  std::size_t size() const { return count_; }
  // Whether the points lie one after the other with nothing between them, from data() on.
  bool is_packed() const { return stride_ == sizeof(glm::vec3); }
  const void* data() const { return first_; }
  glm::vec3 operator[](std::size_t i) const {
    float point[3];
    std::memcpy(point, first_ + i * stride_, sizeof(point));
    return {point[0], point[1], point[2]};
  }

 private:
  const std::byte* first_ = nullptr;
  std::size_t count_ = 0;
  std::size_t stride_ = 0;
};

}  // namespace lkao
