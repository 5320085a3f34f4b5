#include "bench/rounding.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "bvh/scalar_kernel.h"
#include "bvh/scene_layout.h"

namespace lkao::bench {
namespace {

// A single ray, moved.
bool is_blocked(const AmbientOcclusion& ao, const Receiver& receiver, const ReceiverRays& rays, int ray,
                const glm::vec3& shift, float stretch) {
  ReceiverRays moved;
  moved.origin = rays.origin + shift;
  moved.up = rays.up;
  moved.ray_count = 1;
  const glm::vec3 segment = stretch * rays.ray(ray);
  for (int i = 0; i < 64; ++i) moved.x[i] = moved.y[i] = moved.z[i] = 0;
  moved.x[0] = segment.x;
  moved.y[0] = segment.y;
  moved.z[0] = segment.z;
  OcclusionMask open;
  open.set(0);
  const bvh::SceneLayout& scene = ao.occluders().layout();
  const bvh::Query query{.roots = scene.roots(),
                         .rays = moved,
                         .open = open,
                         .radius = 1.001f * rays.radius,
                         .sidedness = ao.options().sidedness,
                         .excluded_primitive = receiver.excluded_primitive,
                         .excluded_instance = receiver.excluded_instance,
                         .groups = receiver.occluder_groups};
  return bvh::trace_scalar(scene, query).any();
}

bool is_explained(const AmbientOcclusion& ao, const Receiver& receiver, const ReceiverRays& rays, int ray) {
  const float size =
      std::max({std::fabs(rays.origin.x), std::fabs(rays.origin.y), std::fabs(rays.origin.z), rays.radius});
  const float step = 0x1p-21f * size;
  const bool answer = is_blocked(ao, receiver, rays, ray, glm::vec3(0), 1);
  for (const float stretch : {1.0f, 1 - 0x1p-20f, 1 + 0x1p-20f}) {
    for (int i = 0; i < 27; ++i) {
      const glm::vec3 shift(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      if (is_blocked(ao, receiver, rays, ray, step * shift, stretch) != answer) return true;
    }
  }
  return false;
}

}  // namespace

std::uint64_t count_unexplained(const AmbientOcclusion& ao, std::span<const Receiver> receivers,
                                std::span<const std::uint64_t> masks, std::span<const std::uint64_t> expected) {
  const auto word_count = static_cast<std::size_t>(ao.pattern().word_count());
  std::uint64_t count = 0;
  ReceiverRays rays;
  for (std::size_t k = 0; k < receivers.size(); ++k) {
    for (int ray = 0; ray < ao.pattern().ray_count(); ++ray) {
      const std::size_t word = k * word_count + static_cast<std::size_t>(ray) / 64;
      if (((masks[word] ^ expected[word]) >> (ray % 64) & 1) == 0) continue;
      ao.rays(receivers[k], k, rays);
      count += !is_explained(ao, receivers[k], rays, ray);
    }
  }
  return count;
}

}  // namespace lkao::bench
