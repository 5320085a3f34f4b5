// The bytes of a glTF's images.
#pragma once

#include <string>
#include <string_view>

namespace lkao::scene::gltf {

// "image/png" or "image/jpeg", by the first bytes; "" for other images.
std::string image_type_of(std::string_view bytes);

// The bytes that a URI names, seen from the file at `path`. Throws std::runtime_error with the fault.
std::string read_uri(const std::string& path, std::string_view uri);

// The same, but none where they cannot be read: images that are missing are no fault here.
std::string bytes_of_uri(const std::string& path, std::string_view uri);

}  // namespace lkao::scene::gltf
