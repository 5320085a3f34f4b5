// What a glTF file asks of its reader.
#pragma once

#include "scene/formats/gltf/value.h"

namespace lkao::scene::gltf {

// Throws std::runtime_error where the file is of another version than 2.0, or needs an extension that is not known:
// what such a file would show without it is not its geometry.
void check_requirements(const Value& root);

}  // namespace lkao::scene::gltf
