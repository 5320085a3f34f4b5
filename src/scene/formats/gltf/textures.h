// How a material's textures lie on surfaces.
#pragma once

#include <optional>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>

#include "scene/contents.h"
#include "scene/formats/gltf/value.h"

namespace lkao::scene::gltf {

// KHR_texture_transform: textures may lie elsewhere than the texture coordinates of vertices say.
class UvTransform {
 public:
  // Throws std::runtime_error with the fault.
  explicit UvTransform(const Value& extension);

  glm::vec2 operator()(const glm::vec2& uv) const;
  bool operator==(const UvTransform&) const = default;

 private:
  glm::dmat2 turned_and_scaled_;
  glm::dvec2 offset_;
};

// The set of texture coordinates that a texture of a material uses.
std::size_t uv_set_of(const Value& texture);

// The extension that says where a map of occlusion lies for this material and this set of texture coordinates: that of
// the occlusion map that it has already. Coordinates in integers that stand for themselves (KHR_mesh_quantization) are
// none without a transform: that of any of its textures then. Nothing where there is no such: coordinates are taken as
// they are.
std::optional<Value> occlusion_transform(const Value& material, std::size_t uv_set, bool has_plain_integers);

// What a material's map of occlusion shows beyond its borders: what the map does that it has already, or another of its
// textures for this set of texture coordinates. Repeated where there is none.
TextureWraps wraps_of(const Value& root, const Value& material, std::size_t uv_set);

// The same of one texture that a material uses.
TextureWraps wraps_of_texture(const Value& root, const Value& texture);

// Whether it is shown enlarged with values between those of its texels, as where the file does not say.
bool is_smooth(const Value& root, const Value& texture);

}  // namespace lkao::scene::gltf
