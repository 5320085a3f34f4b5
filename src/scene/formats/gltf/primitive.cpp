#include "scene/formats/gltf/primitive.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

namespace lkao::scene::gltf {

namespace {

// Nothing for points and lines.
std::optional<Mode> find_mode(const Value& json) {
  const std::size_t mode = count_or(json, "mode", 4);
  if (mode > 6)
    throw std::runtime_error(fmt::format("{} has the mode {}, which glTF does not know", json.place(), mode));
  return mode < 4 ? std::nullopt : std::optional(static_cast<Mode>(mode));
}

}  // namespace

Primitive::Primitive(Value json, Value attributes, Mode mode, Accessors& accessors)
    : json_(std::move(json)), attributes_(std::move(attributes)), mode_(mode), accessors_(&accessors) {}

std::optional<Primitive> Primitive::open(const Value& json, Accessors& accessors, Buffers& buffers) {
  const std::optional<Mode> mode = find_mode(json);
  const std::optional<Value> attributes = json.find("attributes");
  const std::optional<Value> position = attributes ? attributes->find("POSITION") : std::nullopt;
  if (!mode || !position) return std::nullopt;
  Primitive primitive(json, *attributes, *mode, accessors);
  if (const std::optional<Value> extension = json.extension("KHR_draco_mesh_compression")) {
    primitive.draco_.emplace(buffers.view(extension->at("bufferView")).bytes, extension->place());
    primitive.packed_attributes_ = extension->at("attributes");
    primitive.vertex_count_ = primitive.draco_->vertex_count();
  } else {
    primitive.vertex_count_ = accessors.open(*position, "VEC3").count();
  }
  return primitive;
}

std::vector<glm::uvec3> Primitive::triangles() const {
  // Draco unpacks strips to lists.
  if (draco_) return make_triangles(Mode::triangles, draco_->indices(), vertex_count_, json_.place());
  std::vector<std::uint32_t> indices;
  if (const std::optional<Value> index = json_.find("indices")) {
    indices = accessors_->open(*index, "SCALAR").indices();
  } else {
    indices.resize(vertex_count_);
    std::iota(indices.begin(), indices.end(), 0u);
  }
  return make_triangles(mode_, indices, vertex_count_, json_.place());
}

template <typename Vector>
bool Primitive::read_packed(const char* attribute, std::vector<Vector>& values) const {
  const std::optional<Value> number = draco_ ? packed_attributes_->find(attribute) : std::nullopt;
  if (!number) return false;
  values.resize(vertex_count_);
  if (values.empty()) return true;
  const bool is_normalized = accessors_->is_normalized(attributes_.at(attribute));
  draco_->read(number->count(), Vector::length(), is_normalized, glm::value_ptr(values.front()));
  return true;
}

std::vector<glm::dvec2> Primitive::vec2s(const char* attribute) const {
  std::vector<glm::dvec2> values;
  if (read_packed(attribute, values)) return values;
  return accessors_->open(attributes_.at(attribute), "VEC2", vertex_count_).vec2s();
}

std::vector<glm::dvec3> Primitive::vec3s(const char* attribute) const {
  std::vector<glm::dvec3> values;
  if (read_packed(attribute, values)) return values;
  return accessors_->open(attributes_.at(attribute), "VEC3", vertex_count_).vec3s();
}

std::vector<glm::dvec4> Primitive::vec4s(const char* attribute) const {
  std::vector<glm::dvec4> values;
  if (read_packed(attribute, values)) return values;
  return accessors_->open(attributes_.at(attribute), "VEC4", vertex_count_).vec4s();
}

bool Primitive::has_plain_integers(const char* attribute) const {
  return accessors_->has_plain_integers(attributes_.at(attribute));
}

std::size_t Primitive::accessor_number(const char* attribute, std::size_t none) const {
  return count_or(attributes_, attribute, none);
}

std::size_t Primitive::uv_set_count() const {
  const std::vector<std::string> names = attributes_.keys();
  return static_cast<std::size_t>(
      std::count_if(names.begin(), names.end(), [](const std::string& name) { return name.starts_with("TEXCOORD_"); }));
}

}  // namespace lkao::scene::gltf
