// What a mesh file says about itself, to notice what assimp passes over in silence.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace lkao::scene {

// Looks for truncation in the bytes of an STL file, and counts the triangles that it promises where that can be told
// apart from reading it (binary STL). Other extensions promise nothing. Throws std::runtime_error with the fault.
std::optional<std::size_t> check_file(std::string_view bytes, const std::string& extension);

}  // namespace lkao::scene
