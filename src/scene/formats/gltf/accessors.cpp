#include "scene/formats/gltf/accessors.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include "scene/formats/text.h"

namespace lkao::scene::gltf {

namespace {

// Columns of matrices begin at multiples of four bytes; those of MAT4 always do.
std::size_t width_of(std::string_view shape) {
  if (shape == "SCALAR") return 1;
  if (shape == "VEC2") return 2;
  return shape == "VEC3" ? 3 : shape == "VEC4" ? 4 : 16;
}

ComponentType component_type(const Value& object) {
  const Value value = object.at("componentType");
  const std::size_t number = value.count();
  for (const ComponentType type : {ComponentType::int8, ComponentType::uint8, ComponentType::int16,
                                   ComponentType::uint16, ComponentType::uint32, ComponentType::float32}) {
    if (number == static_cast<std::size_t>(type)) return type;
  }
  throw std::runtime_error(fmt::format("{} is {}, which is no type of glTF's", value.place(), number));
}

bool is_index_type(ComponentType type) {
  return type == ComponentType::uint8 || type == ComponentType::uint16 || type == ComponentType::uint32;
}

// The rows of a buffer view from an offset on. The last need not fill the stride.
Rows rows_of(const std::string& place, const BufferView& view, std::size_t offset, std::size_t count,
             std::size_t element_size, std::size_t width) {
  const std::size_t stride = view.stride == 0 ? element_size : view.stride;
  if (stride < element_size) {
    throw std::runtime_error(fmt::format("{}: the stride {} is below the {} bytes of an element of {}", view.place,
                                         stride, element_size, place));
  }
  // Divided rather than multiplied: nothing overflows.
  const std::size_t room = view.bytes.size() - std::min(offset, view.bytes.size());
  const bool fits = count == 0 || (room >= element_size && (room - element_size) / stride >= count - 1);
  if (!fits) {
    throw std::runtime_error(fmt::format("{}: {} elements of {} bytes at {} go beyond {} of {} bytes", place, count,
                                         element_size, offset, view.place, view.bytes.size()));
  }
  return {view.bytes.data() + std::min(offset, view.bytes.size()), stride, count, width};
}

}  // namespace

template <typename Number, typename... Arguments>
void Accessor::read_into(Number* out, Arguments... arguments) const {
  if (rows_) decode(*rows_, type_, arguments..., out);
  if (!sparse_) return;
  Rows value = sparse_->values;
  value.count = 1;
  for (const std::uint32_t element : sparse_->elements) {
    decode(value, type_, arguments..., out + element * width_);
    value.data += value.stride;
  }
}

template <typename Element>
std::vector<Element> Accessor::read() const {
  std::vector<Element> elements(count_, Element(0.0));
  if (count_ > 0) read_into(glm::value_ptr(elements.front()), is_normalized_);
  return elements;
}

std::vector<glm::dvec2> Accessor::vec2s() const { return read<glm::dvec2>(); }
std::vector<glm::dvec3> Accessor::vec3s() const { return read<glm::dvec3>(); }
std::vector<glm::dvec4> Accessor::vec4s() const { return read<glm::dvec4>(); }
std::vector<glm::dmat4> Accessor::mat4s() const { return read<glm::dmat4>(); }

std::vector<std::uint32_t> Accessor::indices() const {
  if (!is_index_type(type_)) {
    throw std::runtime_error(fmt::format("{}: indices of component type {}", place_, static_cast<int>(type_)));
  }
  std::vector<std::uint32_t> indices(count_, 0);
  read_into(indices.data());
  return indices;
}

Accessor Accessors::open(const Value& index, const char* shape, std::optional<std::size_t> count) {
  const Value object = item_of_list(root_, "accessors", index);
  Accessor accessor;
  accessor.place_ = object.place();
  accessor.count_ = object.at("count").count();
  accessor.type_ = component_type(object);
  if (object.at("type").text() != shape) {
    throw std::runtime_error(fmt::format("{} is {}, but {} needs {}", object.place(),
                                         in_quotes(object.at("type").text()), index.place(), shape));
  }
  accessor.width_ = width_of(shape);
  accessor.is_normalized_ = is_normalized(index);
  if (count && accessor.count_ != *count) {
    throw std::runtime_error(
        fmt::format("{} has {} elements, but {} needs {}", object.place(), accessor.count_, index.place(), *count));
  }
  if (object.find("bufferView")) accessor.rows_ = rows_of_values(object, accessor, accessor.count_);
  if (const std::optional<Value> sparse = object.find("sparse")) accessor.sparse_ = open_sparse(*sparse, accessor);
  if (!accessor.rows_ && !count && accessor.count_ > buffers_->byte_count()) {
    throw std::runtime_error(fmt::format("{}: {} elements without a bufferView, in a file of {} bytes", object.place(),
                                         accessor.count_, buffers_->byte_count()));
  }
  return accessor;
}

bool Accessors::has_plain_integers(const Value& index) const {
  return component_type(item_of_list(root_, "accessors", index)) != ComponentType::float32 && !is_normalized(index);
}

std::string Accessors::shape_of(const Value& index) const {
  return item_of_list(root_, "accessors", index).at("type").text();
}

bool Accessors::is_normalized(const Value& index) const {
  const std::optional<Value> normalized = item_of_list(root_, "accessors", index).find("normalized");
  return normalized && normalized->boolean();
}

Rows Accessors::rows_of_values(const Value& place, const Accessor& accessor, std::size_t count) {
  return rows_of(place.place(), buffers_->view(place.at("bufferView")), count_or(place, "byteOffset", 0), count,
                 size_of(accessor.type_) * accessor.width_, accessor.width_);
}

Accessor::Sparse Accessors::open_sparse(const Value& sparse, const Accessor& accessor) {
  const std::size_t count = sparse.at("count").count();
  const Value indices = sparse.at("indices");
  const ComponentType type = component_type(indices);
  if (!is_index_type(type)) throw std::runtime_error(fmt::format("{}: a component type of no index", indices.place()));
  const Rows rows = rows_of(indices.place(), buffers_->view(indices.at("bufferView")),
                            count_or(indices, "byteOffset", 0), count, size_of(type), 1);
  std::vector<std::uint32_t> elements(count);
  decode(rows, type, elements.data());
  for (const std::uint32_t element : elements) {
    if (element >= accessor.count_) {
      throw std::runtime_error(fmt::format("{} names element {} of {}", indices.place(), element, accessor.count_));
    }
  }
  return {std::move(elements), rows_of_values(sparse.at("values"), accessor, count)};
}

}  // namespace lkao::scene::gltf
