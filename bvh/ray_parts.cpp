#include "bvh/ray_parts.h"

#include <algorithm>

namespace lkao::bvh {

RayParts make_ray_parts(std::span<const float> lengths, float radius, float r_min, float r_max) {
  RayParts parts;
  parts.near = r_min;
  parts.far = std::min(r_max, radius);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const float length = lengths[i] * radius;
    const bool exists = r_min < length;
    if (exists) parts.existing.set(static_cast<int>(i));
    parts.begin[i] = exists ? r_min / length : 1.0f;
    parts.end[i] = r_max < length ? r_max / length : 1.0f;
  }
  for (std::size_t i = lengths.size(); i % 64 != 0; ++i) parts.begin[i] = parts.end[i] = 1.0f;
  return parts;
}

}  // namespace lkao::bvh
