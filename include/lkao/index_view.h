// Indices of triangles in arrays of any layout.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include <glm/vec3.hpp>

#include "lkao/export.h"
#include "lkao/requirements.h"

namespace lkao {

// A view of triangles that somebody else keeps; owns nothing and copies nothing. Three indices a triangle, of 16 or 32
// bits, at any alignment and any distance.
class LKAO_API IndexView {
 public:
  IndexView() = default;

  // Of vectors, arrays and spans of glm::uvec3.
  template <std::convertible_to<std::span<const glm::uvec3>> Triangles>
  IndexView(const Triangles& triangles) : IndexView(std::span<const glm::uvec3>(triangles)) {}
  IndexView(std::span<const glm::uvec3> triangles)
      : first_(reinterpret_cast<const std::byte*>(triangles.data())),
        count_(triangles.size()),
        stride_(sizeof(glm::uvec3)) {}

  // `first` is the first index of triangle 0, the other two follow it; each triangle begins `stride` bytes after the
  // one before; 0: packed. Throws std::invalid_argument where triangles would overlap.
  IndexView(const std::uint16_t* first, std::size_t triangle_count, std::size_t stride = 0)
      : IndexView(first, triangle_count, stride, Type::uint16) {}
  IndexView(const std::uint32_t* first, std::size_t triangle_count, std::size_t stride = 0)
      : IndexView(first, triangle_count, stride, Type::uint32) {}
  IndexView(const std::int32_t* first, std::size_t triangle_count, std::size_t stride = 0)
      : IndexView(first, triangle_count, stride, Type::int32) {}

  // How many triangles there are.
  std::size_t size() const { return count_; }
  const void* data() const { return first_; }
  // The three indices of a triangle. Negative ones wrap.
  glm::uvec3 operator[](std::size_t triangle) const {
    return {index(triangle, 0), index(triangle, 1), index(triangle, 2)};
  }
  // One of them, `corner` 0, 1 or 2, as it is written: negative ones stay negative.
  std::int64_t index(std::size_t triangle, int corner) const {
    const std::byte* const from = first_ + triangle * stride_;
    switch (type_) {
      case Type::uint16:
        return read<std::uint16_t>(from, corner);
      case Type::int32:
        return read<std::int32_t>(from, corner);
      default:
        return read<std::uint32_t>(from, corner);
    }
  }
  // The same triangles in memory, seen in the same way.
  friend bool operator==(const IndexView&, const IndexView&) = default;

 private:
  enum class Type { uint16, uint32, int32 };

  IndexView(const void* first, std::size_t triangle_count, std::size_t stride, Type type);

  template <typename Index>
  static Index read(const std::byte* triangle, int corner) {
    Index index;
    std::memcpy(&index, triangle + static_cast<std::size_t>(corner) * sizeof(Index), sizeof(Index));
    return index;
  }

  const std::byte* first_ = nullptr;
  std::size_t count_ = 0;
  std::size_t stride_ = 0;
  Type type_ = Type::uint32;
};

}  // namespace lkao
