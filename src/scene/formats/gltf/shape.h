// A mesh of a glTF, read: morphed as it is at rest, not yet in its place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "scene/formats/gltf/accessors.h"
#include "scene/formats/gltf/holes.h"
#include "scene/formats/gltf/textures.h"

namespace lkao::scene::gltf {

// Four joints of a skin that move a vertex, and how much each does.
struct Influences {
  std::vector<glm::dvec4> joints;
  std::vector<glm::dvec4> weights;
};

struct Vertices {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;        // as many, or none
  std::vector<Influences> influences;     // JOINTS_0, JOINTS_1, ...
  std::vector<std::uint32_t> primitives;  // whose vertices they are, by number in the mesh
};

// The texture coordinates of a primitive: a list in Shape::uvs, and what its material does to them.
struct PartUvs {
  std::size_t list;
  std::optional<UvTransform> transform;
};

// The triangles of a primitive.
struct Part {
  std::size_t vertices;  // index in Shape::vertices
  std::vector<glm::uvec3> triangles;
  std::optional<std::size_t> material;
  std::size_t uv_set_count;
  std::optional<PartUvs> uvs = {};       // where they were asked for, and it has them
  std::vector<HoleTriangle> holes = {};  // as of HoleReader::read()
};

struct Shape {
  std::vector<Vertices> vertices;           // those of primitives with the same accessors once
  std::vector<Part> parts;                  // without those that have no triangles
  std::vector<std::vector<glm::vec2>> uvs;  // of vertices; those of primitives with the same accessors once

  std::size_t vertex_count() const;
  std::size_t triangle_count() const;
};

class ShapeReader {
 public:
  // uv_set: the number of the texture coordinates to read; none where it is nothing. All must outlive it.
  ShapeReader(const Value& root, Accessors& accessors, Buffers& buffers, std::optional<int> uv_set, HoleReader& holes)
      : root_(root), accessors_(&accessors), buffers_(&buffers), uv_set_(uv_set), holes_(&holes) {}

  // `weights` of the morph targets: a list of numbers, or nothing for the mesh's own. Influences are read where
  // is_skinned. Throws std::runtime_error with the fault.
  Shape read(const Value& mesh, const std::optional<Value>& weights, bool is_skinned);

 private:
  Value root_;
  Accessors* accessors_;
  Buffers* buffers_;
  std::optional<int> uv_set_;
  HoleReader* holes_;
};

}  // namespace lkao::scene::gltf
