// glTF 2.0 and GLB: every triangle of the scene as it stands at rest.
//
// Based on: Khronos Group, "glTF 2.0 Specification", 2021, and the extensions that requirements.cpp names.
#include <new>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "scene/formats/gltf/container.h"
#include "scene/formats/gltf/holes.h"
#include "scene/formats/gltf/parse.h"
#include "scene/formats/gltf/requirements.h"
#include "scene/formats/gltf/scene_reader.h"
#include "scene/formats/readers.h"

namespace lkao::scene {

FileMesh read_gltf(const std::string& path, std::string_view bytes, const MeshWishes& wishes) {
  try {
    const gltf::Container container = gltf::open_container(bytes);
    const nlohmann::json document = gltf::parse(container.json);
    const gltf::Value root(document, "");
    gltf::check_requirements(root);
    gltf::Buffers buffers(root, container.binary, path, bytes.size());
    gltf::HoleReader holes(root, buffers, path, wishes.decode_alpha);
    return gltf::SceneReader(root, buffers, wishes.uv_set, wishes.objects, std::move(holes)).read();
  } catch (const std::bad_alloc&) {
    throw std::runtime_error("there is not enough memory for what it shows");
  }
}

}  // namespace lkao::scene
