// What a mesh file says about itself, to notice what assimp passes over in silence.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace lkao::scene {

// Looks for truncation in the bytes of a glTF or GLB file and in the buffers beside it, and counts the triangles that
// it promises where that can be told apart from reading it (glTF 2, each mesh once). Throws std::runtime_error with the
// fault.
std::optional<std::size_t> check_file(const std::string& path, std::string_view bytes, const std::string& extension);

}  // namespace lkao::scene
