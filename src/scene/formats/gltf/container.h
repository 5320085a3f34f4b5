// The two forms of a glTF file: text, and GLB, which holds the same text and a buffer in chunks.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lkao::scene::gltf {

struct Container {
  std::string_view json;
  std::optional<std::string_view> binary;     // GLB's own buffer
  std::vector<std::string_view> others = {};  // all other chunks of a GLB, headers included, as they are
  bool is_glb = false;
};

// Tells the forms apart by the first bytes, whatever the file is called. Throws std::runtime_error with the fault.
Container open_container(std::string_view bytes);

// A GLB of this text, this buffer and these chunks, all but those padded as they must be. Throws std::runtime_error
// where it would be longer than its format can say.
std::string make_glb(std::string_view json, std::optional<std::string_view> binary,
                     const std::vector<std::string_view>& others);

}  // namespace lkao::scene::gltf
