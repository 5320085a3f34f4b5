// EXT_meshopt_compression and KHR_meshopt_compression: buffer views as meshoptimizer packs them.
#pragma once

#include <string>
#include <string_view>

#include "scene/formats/gltf/value.h"

namespace lkao::scene::gltf {

// The bytes of the buffer view whose extension this is. Throws std::runtime_error with the fault.
std::string decode_meshopt(const Value& extension, std::string_view compressed);

}  // namespace lkao::scene::gltf
