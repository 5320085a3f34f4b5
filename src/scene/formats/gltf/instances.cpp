#include "scene/formats/gltf/instances.h"

#include <glm/ext/matrix_transform.hpp>

#include "scene/formats/gltf/nodes.h"

namespace lkao::scene::gltf {

std::vector<glm::dmat4> read_instances(const Value& node, Accessors& accessors) {
  const std::optional<Value> extension = node.extension("EXT_mesh_gpu_instancing");
  const std::optional<Value> attributes = extension ? extension->find("attributes") : std::nullopt;
  std::optional<std::size_t> count;  // of the first attribute, and so of all
  const auto open = [&](const char* name, const char* shape) -> std::optional<Accessor> {
    const std::optional<Value> index = attributes ? attributes->find(name) : std::nullopt;
    if (!index) return std::nullopt;
    Accessor accessor = accessors.open(*index, shape, count);
    count = accessor.count();
    return accessor;
  };
  const std::optional<Accessor> translations = open("TRANSLATION", "VEC3");
  const std::optional<Accessor> rotations = open("ROTATION", "VEC4");
  const std::optional<Accessor> scales = open("SCALE", "VEC3");

  std::vector<glm::dmat4> instances(count.value_or(1), glm::dmat4(1.0));
  const auto apply = [&](const auto& values, const auto& step) {
    for (std::size_t i = 0; i < instances.size(); ++i) instances[i] = step(instances[i], values[i]);
  };
  if (translations) apply(translations->vec3s(), [](const auto& m, const auto& t) { return glm::translate(m, t); });
  if (rotations) apply(rotations->vec4s(), [](const auto& m, const auto& q) { return m * rotation_of(q); });
  if (scales) apply(scales->vec3s(), [](const auto& m, const auto& s) { return glm::scale(m, s); });
  return instances;
}

}  // namespace lkao::scene::gltf
