// A receiver on a triangle of a mesh.
#pragma once

#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include "lkao/receiver.h"
#include "scene/corner_normals.h"
#include "scene/facet.h"

namespace lkao::bake {

// What a triangle's receivers have as Receiver::excluded_instance, which no query looks at, as they exclude no
// primitive: its number in Mesh::objects, for those who ask about each object by itself. 0 where there is none.
inline std::uint32_t object_of(const scene::Mesh& mesh, std::size_t triangle) {
  return mesh.objects.empty() || mesh.objects[triangle] == scene::kNoObject ? 0 : mesh.objects[triangle];
}

// At these weights of the corners: the shading normal is interpolated, and the facet's is beside it.
inline Receiver receiver_on(const scene::Facet& facet, const scene::TriangleNormals& normals, const glm::dvec3& w) {
  const auto& [a, b, c] = normals.corners;
  return {.position = glm::vec3(w.x * glm::dvec3(facet.a) + w.y * glm::dvec3(facet.b) + w.z * glm::dvec3(facet.c)),
          .normal = glm::vec3(w.x * glm::dvec3(a) + w.y * glm::dvec3(b) + w.z * glm::dvec3(c)),
          .geometric_normal = glm::vec3(normals.facet)};
}

}  // namespace lkao::bake
