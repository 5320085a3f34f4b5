#include "needles.h"

#include <glm/geometric.hpp>

namespace lkao::tests {
namespace {

void add_triangle(Mesh& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const auto first = static_cast<unsigned>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {a, b, c});
  mesh.triangles.emplace_back(first, first + 1, first + 2);
}

void add_needle(Mesh& mesh, const glm::vec3& point, float size, Touch touch, lut::RandomStream& random) {
  const auto arm = [&] { return random_direction(random) * uniform(random, 0.5f, 1.0f) * size; };
  const glm::vec3 a = arm();
  if (touch == Touch::edge) return add_triangle(mesh, point + a, point - a, point + arm());
  if (touch == Touch::corner) {
    // In one octant.
    const glm::vec3 signs = glm::sign(random_direction(random));
    return add_triangle(mesh, point, point + signs * glm::abs(a), point + signs * glm::abs(arm()));
  }
  glm::vec3 across(1), b = arm();
  if (touch == Touch::flat) across = glm::vec3(1) - glm::abs(random_axis(random));
  add_triangle(mesh, point + across * a, point + across * b, point - across * (a + b));
}

}  // namespace

glm::vec3 random_axis(lut::RandomStream& random) {
  glm::vec3 axis(0);
  axis[static_cast<int>(random.next_below(3))] = random.next_below(2) == 0 ? 1.0f : -1.0f;
  return axis;
}

void add_needles(Mesh& mesh, const glm::vec3& point, float size, Touch touch, lut::RandomStream& random) {
  for (int i = 0; i < 4; ++i) add_needle(mesh, point, size, touch, random);
}

void add_decoys(Mesh& mesh, int count, float gap, float reach, lut::RandomStream& random) {
  for (int i = 0; i < count; ++i) {
    const glm::vec3 point = random_direction(random) * uniform(random, gap, reach);
    add_needles(mesh, point, 0.01f * reach, Touch::inside, random);
  }
}

std::vector<Receiver> pinned_receivers(const SamplePattern& pattern, const RayOptions& options, const Pin& pin,
                                       lut::RandomStream& random) {
  const AmbientOcclusion nothing(OccluderBvh(TriangleMesh{}), pattern, options);
  std::vector<Receiver> receivers;
  const int step = pattern.ray_count() / 64;
  for (int i = static_cast<int>(random.next_below(static_cast<std::uint64_t>(step))); i < pattern.ray_count();
       i += step) {
    Receiver receiver{.normal = pin.along_axes ? random_axis(random) : random_direction(random)};
    const glm::vec3 ray = nothing.rays(receiver, receivers.size()).ray(i);
    receiver.position = -pin.share * ray;
    if (pin.elevation > 0) {
      const glm::dvec3 along = glm::normalize(glm::dvec3(ray));
      const glm::dvec3 up = glm::normalize(glm::cross(along, glm::dvec3(random_direction(random))));
      receiver.geometric_normal = glm::vec3(up + pin.elevation * along);
    }
    receivers.push_back(receiver);
  }
  return receivers;
}

}  // namespace lkao::tests
