// Where a buffer's bytes are: in a file beside the glTF, or in the text itself.
#pragma once

#include <string>
#include <string_view>

namespace lkao::scene::gltf {

bool is_data_uri(std::string_view uri);

// The bytes of a data: URI, in base64 or percent-encoded. Throws std::runtime_error with the fault.
std::string decode_data_uri(std::string_view uri);

// Whether it names a file, seen from that of the glTF: neither bytes nor a place in a network.
bool is_relative_uri(std::string_view uri);

// The URI of a path with slashes.
std::string encode_uri(std::string_view path);

// The path of the file that a relative URI names, seen from the folder of the file at `path`. Writers that do not
// encode "%" are understood where the file exists. Throws std::runtime_error for other schemes than file paths.
std::string resolve_uri(const std::string& path, std::string_view uri);

}  // namespace lkao::scene::gltf
