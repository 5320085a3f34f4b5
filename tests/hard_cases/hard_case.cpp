#include "hard_case.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "support/sanitized.h"

namespace lkao::tests {
namespace {

bool is_finite(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

bool is_finite(const Mesh& mesh, const glm::uvec3& t) {
  return is_finite(mesh.positions[t.x]) && is_finite(mesh.positions[t.y]) && is_finite(mesh.positions[t.z]);
}

// A place on a triangle: a corner, or on an edge, or anywhere on it.
enum class Spot { corner, edge, face };

glm::vec3 spot_on(const Mesh& mesh, const glm::uvec3& t, Spot spot, lut::RandomStream& random) {
  const auto first = static_cast<int>(random.next_below(3));
  const glm::dvec3 a(mesh.positions[t[first]]), b(mesh.positions[t[(first + 1) % 3]]),
      c(mesh.positions[t[(first + 2) % 3]]);
  const double along = random.next_below(4) == 0 ? 0.5 : random.next_double();
  if (spot == Spot::corner) return a;
  if (spot == Spot::edge) return a + along * (b - a);
  const double across = random.next_double();
  return a + across * (1 - along) * (b - a) + across * along * (c - a);
}

glm::vec3 face_normal(const Mesh& mesh, const glm::uvec3& t) {
  const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  return normal == glm::dvec3(0) ? glm::vec3(0, 1, 0) : glm::vec3(glm::normalize(normal));
}

glm::vec3 axis_or_random(lut::RandomStream& random) {
  if (random.next_below(3) != 0) return random_direction(random);
  glm::vec3 axis(0);
  axis[static_cast<int>(random.next_below(3))] = random.next_below(2) == 0 ? 1.0f : -1.0f;
  return axis;
}

}  // namespace

SamplePattern usual_pattern() {
  static const SamplePattern pattern = SamplePattern::standard(128).with_falloff(Falloff::linear());
  return pattern;
}

SamplePattern axis_pattern() {
  std::vector<glm::vec2> points = {{0, 0}, {0.25f, 0.25f}, {-0.5f, 0.5f}, {0.5f, -0.5f}};
  for (int i = 1; i <= 15; ++i) {
    const float x = static_cast<float>(i) / 16;
    points.insert(points.end(), {{x, 0}, {-x, 0}, {0, x}, {0, -x}});
  }
  std::vector<float> lengths;
  for (std::size_t i = 0; i < points.size(); ++i) lengths.push_back(0.25f * static_cast<float>(4 - i % 4));
  return SamplePattern::from_disk(points, lengths);
}

Bounds mesh_bounds(const Mesh& mesh) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Bounds bounds{glm::vec3(kInfinity), glm::vec3(-kInfinity)};
  for (const glm::uvec3& t : mesh.triangles) {
    if (!is_finite(mesh, t)) continue;
    for (int i = 0; i < 3; ++i) {
      bounds.lower = glm::min(bounds.lower, mesh.positions[t[i]]);
      bounds.upper = glm::max(bounds.upper, mesh.positions[t[i]]);
    }
  }
  return bounds;
}

float mesh_size(const Mesh& mesh) {
  const Bounds bounds = mesh_bounds(mesh);
  return glm::distance(bounds.lower, bounds.upper);
}

void aim(ReceiverGroup& group, const SamplePattern& pattern, const glm::vec3& target, const glm::vec3& normal, int ray,
         float share) {
  const AmbientOcclusion nothing(OccluderBvh(TriangleMesh{}), pattern, group.options);
  const glm::vec3 along = nothing.rays({.normal = normal}, group.receivers.size()).ray(ray);
  const glm::vec3 position = glm::dvec3(target) - static_cast<double>(share) * glm::dvec3(along);
  group.receivers.push_back({.position = position, .normal = normal});
}

void add_receivers(ReceiverGroup& group, const HardCase& hard_case, int count, std::uint64_t seed) {
  const Mesh& mesh = hard_case.mesh;
  const Bounds bounds = mesh_bounds(mesh);
  const glm::vec3 center = 0.5f * (bounds.lower + bounds.upper);
  const float half = std::min(mesh_size(mesh), std::max(0.5f * mesh_size(mesh), 1e-3f * group.options.radius));
  lut::RandomStream random(seed);
  for (int k = 0; k < count;) {
    const auto primitive = static_cast<std::uint32_t>(random.next_below(mesh.triangles.size()));
    const glm::uvec3& t = mesh.triangles[primitive];
    if (!is_finite(mesh, t)) continue;
    const glm::vec3 normal = axis_or_random(random);
    const auto ray = static_cast<int>(random.next_below(static_cast<std::uint64_t>(hard_case.pattern.ray_count())));
    const float share = random.next_below(2) == 0 ? 1.0f : uniform(random, 0.05f, 1.0f);
    const int turn = k++ % (group.options.surface_offset == 0 ? 8 : 5);
    std::vector<Receiver>& receivers = group.receivers;
    if (turn == 0) receivers.push_back({.position = center + random_point(random, half), .normal = normal});
    if (turn == 1) receivers.push_back({.position = spot_on(mesh, t, Spot::corner, random), .normal = normal});
    if (turn == 2) receivers.push_back({.position = spot_on(mesh, t, Spot::edge, random), .normal = normal});
    if (turn == 3) {
      const glm::vec3 position = spot_on(mesh, t, Spot::face, random);
      receivers.push_back({.position = position, .normal = face_normal(mesh, t)});
    }
    if (turn == 4) {
      const glm::vec3 position = spot_on(mesh, t, Spot::face, random);
      receivers.push_back({.position = position, .normal = -face_normal(mesh, t), .excluded_primitive = primitive});
    }
    if (turn == 5) aim(group, hard_case.pattern, spot_on(mesh, t, Spot::corner, random), normal, ray, share);
    if (turn == 6) aim(group, hard_case.pattern, spot_on(mesh, t, Spot::edge, random), normal, ray, share);
    if (turn == 7) aim(group, hard_case.pattern, spot_on(mesh, t, Spot::face, random), normal, ray, share);
  }
}

void add_usual_groups(HardCase& hard_case, int count, std::uint64_t seed, const std::vector<float>& radii) {
  if (kIsSanitized) count = std::min(count, 8);  // one of each kind
  const float size = mesh_size(hard_case.mesh);
  for (float radius : radii) {
    hard_case.groups.push_back({{.radius = radius * size, .jitter = {.rotation = 0}, .surface_offset = 0}});
    add_receivers(hard_case.groups.back(), hard_case, count, seed++);
  }
  hard_case.groups.push_back({{.radius = radii[radii.size() / 2] * size, .sidedness = Sidedness::one_sided}});
  add_receivers(hard_case.groups.back(), hard_case, count, seed);
}

}  // namespace lkao::tests
