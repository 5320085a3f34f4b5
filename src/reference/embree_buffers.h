// Meshes in Embree's own buffers, which it pads as its vector loads need.
#pragma once

#include <cstddef>

#include <glm/vec3.hpp>

#include "lkao/index_view.h"
#include "lkao/position_view.h"
#include "scene/embree.h"

namespace lkao::reference {

// A new buffer of the geometry with these values. Null where memory is out: ask rtcGetDeviceError.
template <typename Value, typename View>
const Value* fill_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, const View& values) {
  void* const buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Value), values.size());
  auto* const filled = static_cast<Value*>(buffer);
  if (filled == nullptr) return nullptr;
  for (std::size_t i = 0; i < values.size(); ++i) filled[i] = values[i];
  return filled;
}

inline const glm::vec3* fill_positions(RTCGeometry geometry, const PositionView& positions) {
  return fill_buffer<glm::vec3>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, positions);
}

inline const glm::uvec3* fill_triangles(RTCGeometry geometry, const IndexView& triangles) {
  return fill_buffer<glm::uvec3>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles);
}

}  // namespace lkao::reference
