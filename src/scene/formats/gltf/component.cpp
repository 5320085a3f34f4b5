#include "scene/formats/gltf/component.h"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "scene/formats/gltf/load_number.h"

namespace lkao::scene::gltf {

namespace {

template <typename Number, typename Out, typename Convert>
void decode_rows(const Rows& rows, Out* out, Convert convert) {
  for (std::size_t row = 0; row < rows.count; ++row) {
    const char* const first = rows.data + row * rows.stride;
    for (std::size_t i = 0; i < rows.width; ++i) *out++ = convert(load_number<Number>(first + i * sizeof(Number)));
  }
}

template <typename Number>
void decode_as(const Rows& rows, bool is_normalized, double* out) {
  if (!is_normalized || std::is_floating_point_v<Number>) {
    return decode_rows<Number>(rows, out, [](Number n) { return static_cast<double>(n); });
  }
  // -128 and -127 both are -1.
  constexpr double kLargest = static_cast<double>(std::numeric_limits<Number>::max());
  decode_rows<Number>(rows, out, [](Number n) { return std::max(static_cast<double>(n) / kLargest, -1.0); });
}

}  // namespace

std::size_t size_of(ComponentType type) {
  switch (type) {
    case ComponentType::int8:
    case ComponentType::uint8:
      return 1;
    case ComponentType::int16:
    case ComponentType::uint16:
      return 2;
    case ComponentType::uint32:
    case ComponentType::float32:
      break;
  }
  return 4;
}

void decode(const Rows& rows, ComponentType type, bool is_normalized, double* out) {
  switch (type) {
    case ComponentType::int8:
      return decode_as<std::int8_t>(rows, is_normalized, out);
    case ComponentType::uint8:
      return decode_as<std::uint8_t>(rows, is_normalized, out);
    case ComponentType::int16:
      return decode_as<std::int16_t>(rows, is_normalized, out);
    case ComponentType::uint16:
      return decode_as<std::uint16_t>(rows, is_normalized, out);
    case ComponentType::uint32:
      return decode_as<std::uint32_t>(rows, is_normalized, out);
    case ComponentType::float32:
      return decode_as<float>(rows, is_normalized, out);
  }
}

void decode(const Rows& rows, ComponentType type, std::uint32_t* out) {
  const auto widen = [](auto n) { return static_cast<std::uint32_t>(n); };
  switch (type) {
    case ComponentType::uint8:
      return decode_rows<std::uint8_t>(rows, out, widen);
    case ComponentType::uint16:
      return decode_rows<std::uint16_t>(rows, out, widen);
    default:
      return decode_rows<std::uint32_t>(rows, out, widen);
  }
}

}  // namespace lkao::scene::gltf
