#include "gpu/rounding.h"

#include <bit>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>

namespace lkao::gl::tests {
namespace {

bool is_explained(const TriangleMesh& mesh, const glm::vec3& origin, const glm::vec3& ray) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3 t = mesh.triangles[i];
    if (is_close_call(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], origin, ray, kRounding))
      return true;
  }
  return false;
}

}  // namespace

bool is_close_call(const glm::vec3& corner_a, const glm::vec3& corner_b, const glm::vec3& corner_c,
                   const glm::vec3& origin, const glm::vec3& ray, double share) {
  const glm::dvec3 o(origin), r(ray);
  const glm::dvec3 corners[3] = {glm::dvec3(corner_a) - o, glm::dvec3(corner_b) - o, glm::dvec3(corner_c) - o};
  const glm::dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  // Without area it blocks nothing.
  if (!std::isfinite(normal.x)) return false;
  const double distance = glm::dot(normal, corners[0]), facing = distance < 0 ? -1.0 : 1.0;
  const double size = glm::length(corners[0]) + glm::length(corners[1]) + glm::length(corners[2]) + glm::length(r);
  const double beyond = facing * (glm::dot(r, normal) - distance);
  bool is_close = std::fabs(beyond) <= share * size || std::fabs(distance) <= share * size;
  if (beyond < -share * size) return false;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 &from = corners[i], &to = corners[(i + 1) % 3], along = to - from;
    const double side = facing * glm::dot(r, glm::cross(from, along));
    const double close = share * glm::length(r) * (glm::length(from) + glm::length(to)) * glm::length(along);
    if (side < -close) return false;
    is_close = is_close || side <= close;
  }
  return is_close;
}

std::uint64_t count_unexplained(const TriangleMesh& mesh, const std::vector<std::uint64_t>& a,
                                const std::vector<std::uint64_t>& b, const std::vector<Receiver>& receivers,
                                const SamplePattern& pattern, const RayOptions& options) {
  const AmbientOcclusion ao(OccluderBvh(mesh), pattern, options);
  const auto words = static_cast<std::size_t>(pattern.word_count());
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == b[i]) continue;
    const ReceiverRays rays = ao.rays(receivers[i / words], i / words);
    for (std::uint64_t bits = a[i] ^ b[i]; bits != 0; bits &= bits - 1) {
      const int ray = static_cast<int>(i % words) * 64 + std::countr_zero(bits);
      count += !is_explained(mesh, rays.origin, rays.ray(ray));
    }
  }
  return count;
}

}  // namespace lkao::gl::tests
