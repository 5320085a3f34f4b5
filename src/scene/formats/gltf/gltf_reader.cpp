// glTF 2.0 and GLB: every triangle of the scene as it stands at rest.
//
// Based on: Khronos Group, "glTF 2.0 Specification", 2021, and the extensions that requirements.cpp names.
#include <new>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "scene/formats/gltf/container.h"
#include "scene/formats/gltf/requirements.h"
#include "scene/formats/gltf/scene_reader.h"
#include "scene/formats/readers.h"

namespace lkao::scene {

namespace {

// nlohmann's parser and destructor do not recurse; its copies, comparisons and dump() do.
nlohmann::json parse(std::string_view text) {
  constexpr std::size_t kLongest = 200;  // the message quotes what could not be read
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 1 ...": the part in brackets helps nobody.
    const std::string_view what = error.what();
    throw std::runtime_error("truncated or malformed glTF: " +
                             gltf::shortened(what.substr(what.find(']') + 2), kLongest));
  }
}

}  // namespace

FileMesh read_gltf(const std::string& path, std::string_view bytes) {
  try {
    const gltf::Container container = gltf::open_container(bytes);
    const nlohmann::json document = parse(container.json);
    const gltf::Value root(document, "");
    gltf::check_requirements(root);
    gltf::Buffers buffers(root, container.binary, path, bytes.size());
    return gltf::SceneReader(root, buffers).read();
  } catch (const std::bad_alloc&) {
    throw std::runtime_error("there is not enough memory for what it shows");
  }
}

}  // namespace lkao::scene
