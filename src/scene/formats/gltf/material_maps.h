// Maps of occlusion, as textures of a glTF's materials.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "scene/formats/gltf/document.h"

namespace lkao::scene::gltf {

// As GltfFile::packed_image has it: the number of that image.
std::optional<std::size_t> find_packed_image(const Value& root, std::size_t material, int uv_set);

// As GltfFile::with_maps has it.
void add_maps(Document& document, std::span<const OcclusionMap> maps, int uv_set);

}  // namespace lkao::scene::gltf
