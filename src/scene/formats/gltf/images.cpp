#include "scene/formats/gltf/images.h"

#include <stdexcept>

#include "scene/formats/file_bytes.h"
#include "scene/formats/gltf/uri.h"

namespace lkao::scene::gltf {

std::string image_type_of(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return "image/png";
  return bytes.starts_with("\xff\xd8\xff") ? "image/jpeg" : "";
}

std::string read_uri(const std::string& path, std::string_view uri) {
  if (is_data_uri(uri)) return decode_data_uri(uri);
  return std::string(read_regular_file(resolve_uri(path, uri)).view());
}

std::string bytes_of_uri(const std::string& path, std::string_view uri) {
  try {
    return read_uri(path, uri);
  } catch (const std::runtime_error&) {
    return "";
  }
}

}  // namespace lkao::scene::gltf
