// The cube of gltf_cube(), packed by the compressions that glTF knows.
#pragma once

#include <string>
#include <vector>

#include "scene/gltf_builder.h"

namespace lkao::scene {

// Positions and normals (0, 0, 1), in Draco's bytes alone.
GltfBuilder draco_cube();

// Positions and indices, whose views are in a buffer that does not exist.
GltfBuilder meshopt_cube();

// `view` says what is packed: makes the buffer view packed.size() bytes of `packed`.
void pack_view(GltfBuilder& builder, std::size_t view, const std::string& packed, std::size_t count, std::size_t stride,
               const char* mode, const char* filter = "NONE");
std::string pack_vertices(const std::string& bytes, std::size_t stride);

}  // namespace lkao::scene
