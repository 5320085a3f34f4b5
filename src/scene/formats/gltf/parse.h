// The JSON of a glTF.
#pragma once

#include <string_view>

#include <nlohmann/json.hpp>

namespace lkao::scene::gltf {

// Throws std::runtime_error with the fault. nlohmann's parser and destructor do not recurse; its copies, comparisons
// and dump() do.
nlohmann::json parse(std::string_view text);

}  // namespace lkao::scene::gltf
