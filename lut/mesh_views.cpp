#include "lut/mesh_views.h"

#include <stdexcept>

#include <fmt/format.h>

#include "lkao/position_view.h"
#include "lut/require.h"

namespace lkao {
namespace {

template <typename Number>
std::size_t checked_stride(std::size_t stride, const char* name) {
  constexpr std::size_t kPacked = 3 * sizeof(Number);
  const char* const range = kPacked == 12 ? "0 or at least 12 bytes" : "0 or at least 6 bytes";
  lut::require(stride == 0 || stride >= kPacked, name, range, static_cast<double>(stride));
  return stride == 0 ? kPacked : stride;
}

const std::byte* bytes_of(const void* data) { return static_cast<const std::byte*>(data); }

}  // namespace

PositionView::PositionView(const float* first, std::size_t count, std::size_t stride)
    : first_(bytes_of(first)), count_(count), stride_(checked_stride<float>(stride, "stride of positions")) {}

IndexView::IndexView(const std::uint16_t* first, std::size_t triangle_count, std::size_t stride)
    : first_(bytes_of(first)),
      count_(triangle_count),
      stride_(checked_stride<std::uint16_t>(stride, "stride of triangles")),
      type_(Type::uint16) {}

IndexView::IndexView(const std::uint32_t* first, std::size_t triangle_count, std::size_t stride)
    : first_(bytes_of(first)),
      count_(triangle_count),
      stride_(checked_stride<std::uint32_t>(stride, "stride of triangles")),
      type_(Type::uint32) {}

IndexView::IndexView(const std::int32_t* first, std::size_t triangle_count, std::size_t stride)
    : first_(bytes_of(first)),
      count_(triangle_count),
      stride_(checked_stride<std::int32_t>(stride, "stride of triangles")),
      type_(Type::int32) {}

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
