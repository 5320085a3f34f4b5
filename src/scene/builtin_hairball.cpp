// builtin:hairball, thin tubes wound around a core.
#include <cmath>

#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include "scene/builtin.h"
#include "scene/shapes.h"

namespace lkao::scene {

namespace {

constexpr double kBallRadius = 5;
constexpr double kCoreRadius = 1;
constexpr int kCoreSegmentCount = 48;
constexpr int kCoreRingCount = 31;
constexpr double kHairRadius = 0.012;
constexpr std::uint32_t kSideCount = 5;
constexpr std::uint32_t kSegmentCount = 48;
constexpr std::uint32_t kTrianglesPerHair = 2 * kSideCount * kSegmentCount;
constexpr std::uint32_t kVerticesPerHair = kSideCount * (kSegmentCount + 1);
constexpr double kSegmentLength = 0.2;

// The next direction of a hair: it wanders, is turned back inside near the ball's surface, and outside at the core.
glm::dvec3 bend(const glm::dvec3& position, const glm::dvec3& direction, Random& random) {
  const double distance = glm::length(position);
  const glm::dvec3 outwards = position / distance;
  const double share = distance / kBallRadius;
  glm::dvec3 next = direction + 0.28 * random.unit_vector();
  if (share > 0.7) next -= 0.8 * (share - 0.7) / 0.3 * outwards;
  if (distance < 1.5 * kCoreRadius) next += 0.5 * outwards;
  return glm::normalize(next);
}

void write_ring(glm::vec3* vertices, const glm::dvec3& center, const glm::dvec3& side, const glm::dvec3& up) {
  for (std::uint32_t i = 0; i < kSideCount; ++i) {
    const glm::dvec2 circle = kHairRadius * unit_circle(static_cast<double>(i) / kSideCount);
    vertices[i] = glm::vec3(center + circle.x * side + circle.y * up);
  }
}

void write_hair_vertices(glm::vec3* vertices, std::uint64_t hair) {
  Random random(0x4a17ba11u + 0x632be59bd9b4e019u * hair);
  glm::dvec3 direction = random.unit_vector();
  glm::dvec3 position = 0.95 * kCoreRadius * direction;  // the root is inside the core
  glm::dvec3 side = glm::normalize(glm::cross(direction, random.unit_vector()));
  for (std::uint32_t ring = 0; ring <= kSegmentCount; ++ring) {
    // The frame is carried along without twist.
    side = glm::normalize(side - glm::dot(side, direction) * direction);
    write_ring(vertices + ring * kSideCount, position, side, glm::cross(direction, side));
    position += kSegmentLength * direction;
    direction = bend(position, direction, random);
  }
}

void write_hair_triangles(glm::uvec3* triangles, std::uint32_t first_vertex) {
  for (std::uint32_t segment = 0; segment < kSegmentCount; ++segment) {
    for (std::uint32_t i = 0; i < kSideCount; ++i) {
      const std::uint32_t next = (i + 1) % kSideCount;
      const std::uint32_t ring = first_vertex + segment * kSideCount;
      *triangles++ = glm::uvec3(ring + i, ring + next, ring + kSideCount + next);
      *triangles++ = glm::uvec3(ring + i, ring + kSideCount + next, ring + kSideCount + i);
    }
  }
}

}  // namespace

Mesh make_hairball(std::size_t triangle_count) {
  Mesh mesh;
  add_sphere(mesh, glm::dvec3(0.0), kCoreRadius, kCoreSegmentCount, kCoreRingCount);
  const std::size_t core_count = mesh.triangles.size();
  const std::size_t wanted = triangle_count > core_count ? triangle_count - core_count : 0;
  const std::size_t hair_count = (wanted + kTrianglesPerHair / 2) / kTrianglesPerHair;
  const std::size_t first_vertex = mesh.positions.size();
  mesh.positions.resize(first_vertex + hair_count * kVerticesPerHair);
  mesh.triangles.resize(core_count + hair_count * kTrianglesPerHair);
  tbb::parallel_for(std::size_t{0}, hair_count, [&](std::size_t hair) {
    const std::size_t vertex = first_vertex + hair * kVerticesPerHair;
    write_hair_vertices(mesh.positions.data() + vertex, hair);
    write_hair_triangles(mesh.triangles.data() + core_count + hair * kTrianglesPerHair,
                         static_cast<std::uint32_t>(vertex));
  });
  return mesh;
}

}  // namespace lkao::scene
