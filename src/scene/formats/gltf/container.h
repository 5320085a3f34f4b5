// The two forms of a glTF file: text, and GLB, which holds the same text and a buffer in chunks.
#pragma once

#include <optional>
#include <string_view>

namespace lkao::scene::gltf {

struct Container {
  std::string_view json;
  std::optional<std::string_view> binary;  // GLB's own buffer
};

// Tells the forms apart by the first bytes, whatever the file is called. Throws std::runtime_error with the fault.
Container open_container(std::string_view bytes);

}  // namespace lkao::scene::gltf
