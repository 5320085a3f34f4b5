#include "scene/formats/gltf/shape.h"

#include <algorithm>
#include <map>
#include <string>

#include <fmt/format.h>

#include "scene/formats/gltf/primitive.h"

namespace lkao::scene::gltf {

namespace {

using Weights = std::vector<double>;

Weights read_weights(const std::optional<Value>& list) {
  Weights weights(list ? list->size() : 0);
  if (list) list->numbers(weights);
  return weights;
}

std::size_t set_count(const Primitive& primitive) {
  std::size_t count = 0;
  while (primitive.has(fmt::format("JOINTS_{}", count).c_str()) &&
         primitive.has(fmt::format("WEIGHTS_{}", count).c_str())) {
    ++count;
  }
  return count;
}

// The accessors of all that makes vertices: primitives with the same share theirs.
std::vector<std::size_t> key_of(const Primitive& primitive, bool is_skinned) {
  constexpr auto kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> key{primitive.accessor_number("POSITION", kNone),
                               primitive.accessor_number("NORMAL", kNone)};
  for (std::size_t set = 0; is_skinned && set < set_count(primitive); ++set) {
    key.push_back(primitive.accessor_number(fmt::format("JOINTS_{}", set).c_str(), kNone));
    key.push_back(primitive.accessor_number(fmt::format("WEIGHTS_{}", set).c_str(), kNone));
  }
  const std::optional<Value> targets = primitive.json().find("targets");
  for (std::size_t k = 0; targets && k < targets->size(); ++k) {
    for (const char* name : {"POSITION", "NORMAL"}) key.push_back(count_or(targets->element(k), name, kNone));
  }
  return key;
}

void add_displacements(const Value& target, const char* name, double weight, Accessors& accessors,
                       std::vector<glm::dvec3>& values) {
  const std::optional<Value> index = target.find(name);
  if (!index || values.empty()) return;
  const std::vector<glm::dvec3> displacements = accessors.open(*index, "VEC3", values.size()).vec3s();
  for (std::size_t i = 0; i < values.size(); ++i) values[i] += weight * displacements[i];
}

void morph(Vertices& vertices, const Value& primitive, const Weights& weights, Accessors& accessors) {
  const std::optional<Value> targets = primitive.find("targets");
  const std::size_t count = std::min(targets ? targets->size() : 0, weights.size());
  for (std::size_t k = 0; k < count; ++k) {
    if (weights[k] == 0) continue;
    add_displacements(targets->element(k), "POSITION", weights[k], accessors, vertices.positions);
    add_displacements(targets->element(k), "NORMAL", weights[k], accessors, vertices.normals);
  }
}

Vertices read_vertices(const Primitive& primitive, const Weights& weights, bool is_skinned, Accessors& accessors) {
  Vertices vertices;
  vertices.positions = primitive.vec3s("POSITION");
  if (primitive.has("NORMAL")) vertices.normals = primitive.vec3s("NORMAL");
  for (std::size_t set = 0; is_skinned && set < set_count(primitive); ++set) {
    vertices.influences.push_back({primitive.vec4s(fmt::format("JOINTS_{}", set).c_str()),
                                   primitive.vec4s(fmt::format("WEIGHTS_{}", set).c_str())});
  }
  morph(vertices, primitive.json(), weights, accessors);
  return vertices;
}

// Texture coordinates of a mesh's primitives, those of the same accessor once.
class UvReader {
 public:
  UvReader(const Value& root, std::optional<int> set, Shape& shape)
      : root_(root), set_(set), name_(fmt::format("TEXCOORD_{}", set.value_or(0))), shape_(shape) {}

  std::optional<PartUvs> read(const Primitive& primitive) {
    if (!set_ || !primitive.has(name_.c_str())) return std::nullopt;
    const std::size_t next = shape_.uvs.size();
    const std::size_t key = primitive.accessor_number(name_.c_str(), next);
    const std::size_t list = primitive.is_packed() ? next : known_.try_emplace(key, next).first->second;
    if (list == next) {
      const std::vector<glm::dvec2> uvs = primitive.vec2s(name_.c_str());
      shape_.uvs.emplace_back(uvs.begin(), uvs.end());
    } else if (shape_.uvs[list].size() != primitive.vertex_count()) {
      primitive.vec2s(name_.c_str());  // says what is wrong
    }
    return PartUvs{list, transform_of(primitive)};
  }

 private:
  std::optional<UvTransform> transform_of(const Primitive& primitive) const {
    const std::optional<Value> index = primitive.json().find("material");
    if (!index || index->count() >= size_of_list(root_, "materials")) return std::nullopt;
    const std::optional<Value> transform =
        occlusion_transform(item_of_list(root_, "materials", *index), static_cast<std::size_t>(*set_),
                            primitive.has_plain_integers(name_.c_str()));
    return transform ? std::optional(UvTransform(*transform)) : std::nullopt;
  }

  Value root_;
  std::optional<int> set_;
  std::string name_;
  Shape& shape_;
  std::map<std::size_t, std::size_t> known_;  // lists by accessor
};

}  // namespace

std::size_t Shape::vertex_count() const {
  std::size_t count = 0;
  for (const Vertices& some : vertices) count += some.positions.size();
  return count;
}

std::size_t Shape::triangle_count() const {
  std::size_t count = 0;
  for (const Part& part : parts) count += part.triangles.size();
  return count;
}

Shape ShapeReader::read(const Value& mesh, const std::optional<Value>& weights, bool is_skinned) {
  const Weights target_weights = read_weights(weights ? weights : mesh.find("weights"));
  const Value primitives = mesh.at("primitives");
  Shape shape;
  std::map<std::vector<std::size_t>, std::size_t> known;
  UvReader uvs(root_, uv_set_, shape);
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const std::optional<Primitive> primitive = Primitive::open(primitives.element(i), *accessors_, *buffers_);
    if (!primitive) continue;
    std::vector<glm::uvec3> triangles = primitive->triangles();
    if (triangles.empty()) continue;
    std::size_t vertices = shape.vertices.size();
    if (!primitive->is_packed()) vertices = known.try_emplace(key_of(*primitive, is_skinned), vertices).first->second;
    if (vertices == shape.vertices.size()) {
      shape.vertices.push_back(read_vertices(*primitive, target_weights, is_skinned, *accessors_));
    }
    shape.vertices[vertices].primitives.push_back(static_cast<std::uint32_t>(i));
    const std::optional<Value> material = primitive->json().find("material");
    std::vector<HoleTriangle> holes = holes_->read(*primitive, triangles);
    shape.parts.push_back({vertices, std::move(triangles), material ? std::optional(material->count()) : std::nullopt,
                           primitive->uv_set_count(), uvs.read(*primitive), std::move(holes)});
  }
  return shape;
}

}  // namespace lkao::scene::gltf
