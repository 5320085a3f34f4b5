// A mesh of a glTF, read: morphed as it is at rest, not yet in its place.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "scene/formats/gltf/accessors.h"

namespace lkao::scene::gltf {

// Four joints of a skin that move a vertex, and how much each does.
struct Influences {
  std::vector<glm::dvec4> joints;
  std::vector<glm::dvec4> weights;
};

struct Vertices {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;     // as many, or none
  std::vector<Influences> influences;  // JOINTS_0, JOINTS_1, ...
};

// The triangles of a primitive.
struct Part {
  std::size_t vertices;  // index in Shape::vertices
  std::vector<glm::uvec3> triangles;
  std::optional<std::size_t> material;
  std::size_t uv_set_count;
};

struct Shape {
  std::vector<Vertices> vertices;  // those of primitives with the same accessors once
  std::vector<Part> parts;         // without those that have no triangles

  std::size_t vertex_count() const;
  std::size_t triangle_count() const;
};

class ShapeReader {
 public:
  ShapeReader(Accessors& accessors, Buffers& buffers) : accessors_(&accessors), buffers_(&buffers) {}

  // `weights` of the morph targets: a list of numbers, or nothing for the mesh's own. Influences are read where
  // is_skinned. Throws std::runtime_error with the fault.
  Shape read(const Value& mesh, const std::optional<Value>& weights, bool is_skinned);

 private:
  Accessors* accessors_;
  Buffers* buffers_;
};

}  // namespace lkao::scene::gltf
