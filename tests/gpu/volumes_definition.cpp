#include "gpu/volumes_definition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "lkao/ambient_occlusion.h"

namespace lkao::gl::tests {
namespace {

using Triangle = std::array<glm::dvec3, 3>;

std::vector<glm::dvec3> clip(const std::vector<glm::dvec3>& corners, const glm::dvec3& up) {
  std::vector<glm::dvec3> kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 &p = corners[i], &q = corners[(i + 1) % corners.size()];
    const double height = glm::dot(up, p), next = glm::dot(up, q);
    if (height > 0) kept.push_back(p);
    if ((height > 0) != (next > 0)) kept.push_back(p + (q - p) * (height / (height - next)));
  }
  return kept;
}

// Eq. 7; m_k is the normal turned away from the side that the polygon faces.
glm::dvec3 inward(const Triangle& p, std::size_t i, const glm::dvec3& m_k) {
  return glm::normalize(glm::cross(p[(i + 1) % 3] - p[i], m_k));
}

// Eq. 12, its matrix inverted.
glm::dvec3 extension(const Triangle& p, std::size_t i, const glm::dvec3& m_k, const VolumeDefinition& definition) {
  const glm::dmat3 rows(inward(p, i, m_k), inward(p, (i + 2) % 3, m_k), m_k);
  const glm::dvec3 e = glm::inverse(glm::transpose(rows)) * glm::dvec3(-definition.delta, -definition.delta, 0);
  const double most = 2 * definition.delta;
  return definition.clamps_extensions && glm::length(e) > most ? most * glm::normalize(e) : e;
}

// Is the point, seen along the normal, in the base of the volume?
bool is_over_base(const Triangle& p, const glm::dvec3& m_k, const glm::dvec3& point,
                  const VolumeDefinition& definition) {
  Triangle base;
  for (std::size_t i = 0; i < 3; ++i) base[i] = p[i] + extension(p, i, m_k, definition);
  for (std::size_t i = 0; i < 3; ++i) {
    if (glm::dot(point - base[i], inward(base, i, m_k)) < 0) return false;
  }
  return true;
}

// Eq. 5.
double falloff(const Triangle& p, const glm::dvec3& m_k, const glm::dvec3& x, double delta) {
  double g = std::clamp(glm::dot(x - p[0], m_k) / delta + 1, 0.0, 1.0);
  for (std::size_t i = 0; i < 3 && g > 0; ++i) {
    g *= std::clamp(glm::dot(x - p[i], inward(p, i, m_k)) / delta + 1, 0.0, 1.0);
  }
  return g;
}

}  // namespace

double form_factor(const std::vector<glm::dvec3>& corners, const VolumeReceiver& receiver) {
  std::vector<glm::dvec3> p;
  for (const glm::dvec3& corner : corners) p.push_back(corner - receiver.origin);
  p = clip(clip(p, receiver.normal), receiver.up);
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const glm::dvec3 &from = p[i], &to = p[(i + 1) % p.size()];
    const glm::dvec3 across = glm::cross(to, from);
    if (glm::length(across) == 0) continue;
    const double cosine = glm::dot(from, to) / (glm::length(from) * glm::length(to));
    sum += std::acos(std::clamp(cosine, -1.0, 1.0)) * glm::dot(receiver.normal, across) / glm::length(across);
  }
  return sum / (2 * std::numbers::pi);
}

double VolumeDefinition::occlusion(const Mesh& mesh, const VolumeReceiver& receiver) const {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    Triangle p{mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
    glm::dvec3 m_k = glm::normalize(glm::cross(p[2] - p[0], p[1] - p[0]));
    double height = -glm::dot(receiver.origin - p[0], m_k);
    if (height < 0 && is_two_sided) {
      std::swap(p[1], p[2]);
      m_k = -m_k;
      height = -height;
    }
    if (height <= 0) continue;
    const double g = falloff(p, m_k, receiver.origin, delta);
    if (g <= 0 || !is_over_base(p, m_k, receiver.origin, *this)) continue;
    sum +=
        (opacities.empty() ? 1.0 : static_cast<double>(opacities[i])) * g * form_factor({p.begin(), p.end()}, receiver);
  }
  return sum / (0.5 + 0.5 * glm::dot(receiver.normal, receiver.up));
}

std::vector<VolumeReceiver> volume_receivers(const Mesh& mesh, const std::vector<Receiver>& receivers,
                                             const RayOptions& options) {
  const AmbientOcclusion query(OccluderBvh(mesh.view()), SamplePattern::standard(1), options);
  std::vector<VolumeReceiver> found;
  ReceiverRays rays;
  for (const Receiver& receiver : receivers) {
    if (receiver.normal == glm::vec3(0)) {
      found.push_back({.normal = glm::dvec3(0)});
      continue;
    }
    query.rays(receiver, 0, rays);
    found.push_back({rays.origin, glm::normalize(glm::dvec3(receiver.normal)), rays.up});
  }
  return found;
}

}  // namespace lkao::gl::tests
