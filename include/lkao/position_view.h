// Points in arrays of any layout.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstring>
#include <span>

#include <glm/vec3.hpp>

#include "lkao/export.h"
#include "lkao/requirements.h"

namespace lkao {

// A view of points that somebody else keeps; owns nothing and copies nothing. Three floats or doubles a point, at any
// alignment and any distance: interleaved with other data of a vertex, padded to four numbers, or packed.
class LKAO_API PositionView {
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

  // Doubles, as georeferenced scenes have them: a float at 5,000,000 moves in steps of a half. What is seen are floats,
  // each point less the origin, which should lie near (choose_origin); receivers and cameras must then be given less
  // the origin too. Throws std::invalid_argument where points would overlap or the origin is not finite.
  PositionView(const double* first, std::size_t count, const glm::dvec3& origin, std::size_t stride = 0);
  template <std::convertible_to<std::span<const glm::dvec3>> Positions>
  PositionView(const Positions& positions, const glm::dvec3& origin)
      : PositionView(std::span<const glm::dvec3>(positions), origin) {}
  PositionView(std::span<const glm::dvec3> positions, const glm::dvec3& origin)
      : PositionView(reinterpret_cast<const double*>(positions.data()), positions.size(), origin) {}

  std::size_t size() const { return count_; }
  // What the points were before it was taken away: zero for floats.
  const glm::dvec3& origin() const { return origin_; }
  // Whether the points are floats that lie one after the other with nothing between them, from data() on.
  bool is_packed() const { return !are_doubles_ && stride_ == sizeof(glm::vec3); }
  const void* data() const { return first_; }

  glm::vec3 operator[](std::size_t i) const {
    if (are_doubles_) return glm::vec3(exact(i) - origin_);
    return read<float>(i);
  }
  // The same points in memory, seen in the same way.
  friend bool operator==(const PositionView&, const PositionView&) = default;

  // With the origin, in double.
  glm::dvec3 exact(std::size_t i) const {
    return are_doubles_ ? glm::dvec3(read<double>(i)) : glm::dvec3(read<float>(i));
  }

 private:
  template <typename Number>
  glm::vec<3, Number> read(std::size_t i) const {
    Number point[3];
    std::memcpy(point, first_ + i * stride_, sizeof(point));
    return {point[0], point[1], point[2]};
  }

  const std::byte* first_ = nullptr;
  std::size_t count_ = 0;
  std::size_t stride_ = 0;
  bool are_doubles_ = false;
  glm::dvec3 origin_{0};
};

// An origin for points far from zero: the centre of the box around the finite ones, rounded to a power of ten that is
// not below the box's diagonal. Zero where the box lies no farther from zero than 16 times its diagonal: there floats
// are fine. Time linear in the number of points.
LKAO_API glm::dvec3 choose_origin(const PositionView& positions);

}  // namespace lkao
