#include "scene/formats/gltf/textures.h"

#include <cmath>

#include <glm/gtc/type_ptr.hpp>

namespace lkao::scene::gltf {

namespace {

glm::dvec2 vec2_or(const Value& object, const char* key, glm::dvec2 vector) {
  if (const std::optional<Value> numbers = object.find(key)) numbers->numbers({glm::value_ptr(vector), 2});
  return vector;
}

// All that every material may have and that use this set, that of occlusion first.
std::vector<Value> textures_of(const Value& material, std::size_t uv_set) {
  std::vector<Value> textures;
  const auto add = [&](const std::optional<Value>& object, const char* key) {
    const std::optional<Value> texture = object ? object->find(key) : std::nullopt;
    if (texture && uv_set_of(*texture) == uv_set) textures.push_back(*texture);
  };
  const std::optional<Value> looks = material.find("pbrMetallicRoughness");
  add(material, "occlusionTexture");
  add(looks, "baseColorTexture");
  add(looks, "metallicRoughnessTexture");
  add(material, "normalTexture");
  add(material, "emissiveTexture");
  return textures;
}

std::optional<Value> sampler_of(const Value& root, const Value& texture) {
  const std::optional<Value> index = item_of_list(root, "textures", texture.at("index")).find("sampler");
  return index ? std::optional(item_of_list(root, "samplers", *index)) : std::nullopt;
}

TextureWrap wrap_or_repeat(const Value& sampler, const char* key) {
  constexpr std::size_t kClamp = 33071, kMirror = 33648, kRepeat = 10497;
  const std::size_t number = count_or(sampler, key, kRepeat);
  return number == kClamp ? TextureWrap::clamp : number == kMirror ? TextureWrap::mirror : TextureWrap::repeat;
}

}  // namespace

// Scaled, then turned, then moved: as the extension's words and viewers have it, its angle turns coordinates
// counterclockwise as seen on the image, whose v points down.
UvTransform::UvTransform(const Value& extension) : offset_(vec2_or(extension, "offset", glm::dvec2(0.0))) {
  const glm::dvec2 scale = vec2_or(extension, "scale", glm::dvec2(1.0));
  const std::optional<Value> rotation = extension.find("rotation");
  const double angle = rotation ? rotation->number() : 0;
  const double c = std::cos(angle), s = std::sin(angle);
  turned_and_scaled_ = glm::dmat2(glm::dvec2(c, -s) * scale.x, glm::dvec2(s, c) * scale.y);
}

glm::vec2 UvTransform::operator()(const glm::vec2& uv) const {
  return glm::vec2(turned_and_scaled_ * glm::dvec2(uv) + offset_);
}

std::size_t uv_set_of(const Value& texture) {
  const std::size_t set = count_or(texture, "texCoord", 0);
  const std::optional<Value> transform = texture.extension("KHR_texture_transform");
  return transform ? count_or(*transform, "texCoord", set) : set;
}

std::optional<Value> occlusion_transform(const Value& material, std::size_t uv_set, bool has_plain_integers) {
  if (const std::optional<Value> texture = material.find("occlusionTexture");
      texture && uv_set_of(*texture) == uv_set) {
    std::optional<Value> transform = texture->extension("KHR_texture_transform");
    if (transform) return transform;
  }
  if (!has_plain_integers) return std::nullopt;
  for (const Value& texture : textures_of(material, uv_set)) {
    std::optional<Value> transform = texture.extension("KHR_texture_transform");
    if (transform) return transform;
  }
  return std::nullopt;
}

TextureWraps wraps_of(const Value& root, const Value& material, std::size_t uv_set) {
  const std::vector<Value> textures = textures_of(material, uv_set);
  return textures.empty() ? TextureWraps{} : wraps_of_texture(root, textures.front());
}

TextureWraps wraps_of_texture(const Value& root, const Value& texture) {
  const std::optional<Value> sampler = sampler_of(root, texture);
  if (!sampler) return {};
  return {wrap_or_repeat(*sampler, "wrapS"), wrap_or_repeat(*sampler, "wrapT")};
}

bool is_smooth(const Value& root, const Value& texture) {
  constexpr std::size_t kNearest = 9728, kLinear = 9729;
  const std::optional<Value> sampler = sampler_of(root, texture);
  return !sampler || count_or(*sampler, "magFilter", kLinear) != kNearest;
}

}  // namespace lkao::scene::gltf
