#include "lut/mesh_views.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "lkao/position_view.h"
#include "lut/require.h"

namespace lkao {
namespace {

// 0 stands for `packed`, the size of a point or triangle.
std::size_t checked_stride(std::size_t stride, std::size_t packed, const char* name) {
  const std::string range = fmt::format("0 or at least {} bytes", packed);
  lut::require(stride == 0 || stride >= packed, name, range.c_str(), static_cast<double>(stride));
  return stride == 0 ? packed : stride;
}

}  // namespace

PositionView::PositionView(const float* first, std::size_t count, std::size_t stride)
    : first_(reinterpret_cast<const std::byte*>(first)),
      count_(count),
      stride_(checked_stride(stride, 3 * sizeof(float), "stride of positions")) {}

PositionView::PositionView(const double* first, std::size_t count, const glm::dvec3& origin, std::size_t stride)
    : first_(reinterpret_cast<const std::byte*>(first)),
      count_(count),
      stride_(checked_stride(stride, 3 * sizeof(double), "stride of positions")),
      are_doubles_(true),
      origin_(origin) {
  for (int axis = 0; axis < 3; ++axis) {
    lut::require(std::isfinite(origin[axis]), "origin of positions", "finite", origin[axis]);
  }
}

IndexView::IndexView(const void* first, std::size_t triangle_count, std::size_t stride, Type type)
    : first_(static_cast<const std::byte*>(first)),
      count_(triangle_count),
      stride_(checked_stride(stride, type == Type::uint16 ? 6 : 12, "stride of triangles")),
      type_(type) {}

namespace lut {

void check_indices(const IndexView& triangles, std::size_t position_count) {
  const auto end = static_cast<std::int64_t>(position_count);
  for (std::size_t triangle = 0; triangle < triangles.size(); ++triangle) {
    for (int corner = 0; corner < 3; ++corner) {
      const std::int64_t index = triangles.index(triangle, corner);
      if (index >= 0 && index < end) continue;
      throw std::invalid_argument(
          fmt::format("triangle {} has index {}, but there are {} positions", triangle, index, position_count));
    }
  }
}

}  // namespace lut
}  // namespace lkao
