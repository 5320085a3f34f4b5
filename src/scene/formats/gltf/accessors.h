// Arrays of numbers as glTF describes them: types, strides, and sparse ones that name what differs from others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "scene/formats/gltf/buffers.h"
#include "scene/formats/gltf/component.h"
#include "scene/formats/gltf/value.h"

namespace lkao::scene::gltf {

// One accessor, all of which is known to be in the file.
class Accessor {
 public:
  std::size_t count() const { return count_; }

  // The accessor must have been opened as "VEC2", "VEC3", "VEC4", "MAT4" or "SCALAR".
  std::vector<glm::dvec2> vec2s() const;
  std::vector<glm::dvec3> vec3s() const;
  std::vector<glm::dvec4> vec4s() const;
  std::vector<glm::dmat4> mat4s() const;
  std::vector<std::uint32_t> indices() const;

 private:
  friend class Accessors;

  struct Sparse {
    std::vector<std::uint32_t> elements;
    Rows values;  // one for each of them
  };

  template <typename Element>
  std::vector<Element> read() const;
  template <typename Number, typename... Arguments>
  void read_into(Number* out, Arguments... arguments) const;

  std::string place_;
  std::size_t count_ = 0;
  ComponentType type_ = ComponentType::float32;
  bool is_normalized_ = false;
  std::size_t width_ = 1;     // numbers an element
  std::optional<Rows> rows_;  // zeros where there are none
  std::optional<Sparse> sparse_;
};

class Accessors {
 public:
  Accessors(Value root, Buffers& buffers) : root_(std::move(root)), buffers_(&buffers) {}

  // The accessor that `index` names; `shape` is "VEC3" or another of glTF's words. It must have `count` elements where
  // that is given; otherwise as many as there are bytes in the file at most, as zeros need no bytes of their own.
  // Throws std::runtime_error with the fault.
  Accessor open(const Value& index, const char* shape, std::optional<std::size_t> count = {});

  // Whether the accessor that `index` names has integers that stand for themselves, wherever they are.
  bool has_plain_integers(const Value& index) const;
  // Its shape, "VEC3" or another of glTF's words.
  std::string shape_of(const Value& index) const;
  // What the accessor that `index` names says of its integers, wherever they are.
  bool is_normalized(const Value& index) const;

 private:
  Rows rows_of_values(const Value& place, const Accessor& accessor, std::size_t count);
  Accessor::Sparse open_sparse(const Value& sparse, const Accessor& accessor);

  Value root_;
  Buffers* buffers_;
};

}  // namespace lkao::scene::gltf
