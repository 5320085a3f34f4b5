#include "support/brute_force.h"

#include <glm/geometric.hpp>

#include "bvh/ray_triangle.h"
#include "bvh/usable_triangle.h"
#include "lut/coordinates.h"

namespace lkao::tests {

OcclusionMask brute_force_mask(const TriangleMesh& mesh, const ReceiverRays& rays, const RayOptions& options,
                               std::uint32_t excluded_primitive, const bvh::RayParts* parts) {
  OcclusionMask blocked;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3 t = mesh.triangles[i];
    const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    if (i == excluded_primitive || !lut::is_in_range(a, b, c) || bvh::has_zero_area(a, b, c)) continue;
    const bvh::TriangleTest test(a, b, c, rays.origin, rays.radius, options.sidedness);
    if (!test.can_block()) continue;
    for (int ray = 0; ray < rays.ray_count; ++ray) {
      if (!rays.cast.test(ray) || (parts != nullptr && !parts->existing.test(ray))) continue;
      const bool is_blocked = parts == nullptr ? test.blocks(rays.ray(ray))
                                               : test.blocks(rays.ray(ray), parts->begin[ray], parts->end[ray]);
      if (is_blocked) blocked.set(ray);
    }
  }
  return blocked;
}

bool textbook_blocks(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& origin,
                     const glm::vec3& ray, Sidedness sidedness) {
  using Vec = glm::vec<3, long double>;
  const Vec edge1 = Vec(b) - Vec(a), edge2 = Vec(c) - Vec(a), p = glm::cross(Vec(ray), edge2);
  const long double determinant = glm::dot(edge1, p);
  if (determinant == 0) return false;
  if (sidedness == Sidedness::one_sided && determinant < 0) return false;
  const Vec s = Vec(origin) - Vec(a);
  const long double u = glm::dot(s, p) / determinant;
  const Vec q = glm::cross(s, edge1);
  const long double v = glm::dot(Vec(ray), q) / determinant;
  const long double t = glm::dot(edge2, q) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t <= 1;
}

}  // namespace lkao::tests
