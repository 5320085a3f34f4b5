// One primitive of a mesh, whose attributes are accessors or packed by Draco.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "scene/formats/gltf/accessors.h"
#include "scene/formats/gltf/draco.h"
#include "scene/formats/gltf/triangles.h"
#include "scene/formats/gltf/value.h"

namespace lkao::scene::gltf {

// Throws std::runtime_error with the fault.
class Primitive {
 public:
  // Nothing where the primitive has no triangles by its kind: points, lines, or no positions.
  static std::optional<Primitive> open(const Value& json, Accessors& accessors, Buffers& buffers);

  const Value& json() const { return json_; }
  bool has(const char* attribute) const { return attributes_.find(attribute).has_value(); }
  bool is_packed() const { return draco_.has_value(); }
  std::size_t vertex_count() const { return vertex_count_; }

  std::vector<glm::uvec3> triangles() const;
  // An attribute that it has, one value a vertex.
  std::vector<glm::dvec2> vec2s(const char* attribute) const;
  std::vector<glm::dvec3> vec3s(const char* attribute) const;
  std::vector<glm::dvec4> vec4s(const char* attribute) const;

  // Of an attribute that it has: "VEC3" or another of glTF's words.
  std::string shape_of(const char* attribute) const { return accessors_->shape_of(attributes_.at(attribute)); }
  // Whether an attribute that it has is of integers that stand for themselves.
  bool has_plain_integers(const char* attribute) const;
  // The number of an attribute's accessor: what has the same has the same values. `none` where it has no such.
  std::size_t accessor_number(const char* attribute, std::size_t none) const;
  // Texture coordinates that a vertex has.
  std::size_t uv_set_count() const;

 private:
  Primitive(Value json, Value attributes, Mode mode, Accessors& accessors);

  template <typename Vector>
  bool read_packed(const char* attribute, std::vector<Vector>& values) const;

  Value json_;
  Value attributes_;
  Mode mode_;
  Accessors* accessors_;
  std::optional<Value> packed_attributes_;
  std::optional<DracoMesh> draco_;
  std::size_t vertex_count_ = 0;
};

}  // namespace lkao::scene::gltf
