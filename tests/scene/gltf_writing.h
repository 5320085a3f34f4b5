// What the tests of the glTF writer share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "scene/files.h"
#include "scene/formats/gltf/container.h"
#include "scene/gltf_builder.h"
#include "scene/gltf_writer.h"

namespace lkao::scene {

// A model in a folder, and what is written of it.
class GltfWriter : public testing::Test {
 protected:
  // Puts the model there, and reads it.
  void put(const GltfBuilder& builder, const std::string& name = "in.glb") {
    path_ = folder_.write(name, name.ends_with(".glb") ? builder.glb() : builder.gltf());
    contents_ = open_mesh_file(path_, {.uv_set = 0}).contents;
  }

  GltfOutput bake(const std::vector<float>& occlusion, GltfAttribute attribute = GltfAttribute::occlusion) const {
    return GltfFile(path_, folder_.path("out.glb")).with_vertices(contents_, occlusion, attribute);
  }
  // Vertex k has the value k / 8.
  GltfOutput bake() const {
    std::size_t count = 0;
    for (const VertexBlock& block : contents_.vertex_blocks) count += block.vertex_count;
    std::vector<float> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<float>(i) / 8;
    return bake(values);
  }
  GltfOutput add_maps(const std::vector<OcclusionMap>& maps, int uv_set = 0) const {
    return GltfFile(path_, folder_.path("out.glb")).with_maps(maps, uv_set);
  }

  const TemporaryFolder folder_;
  std::string path_;
  Contents contents_;
};

inline nlohmann::json document_of(const std::string& bytes) {
  return nlohmann::json::parse(gltf::open_container(bytes).json);
}
inline std::string binary_of(const std::string& bytes) {
  return std::string(gltf::open_container(bytes).binary.value_or(std::string_view()));
}

inline const nlohmann::json& primitive_of(const nlohmann::json& document, std::size_t mesh, std::size_t primitive = 0) {
  return document["meshes"][mesh]["primitives"][primitive];
}

inline GltfBuilder cube_with_uvs() {
  GltfBuilder parts = gltf_cube();
  parts.primitive()["attributes"]["TEXCOORD_0"] = parts.add_values(std::vector<float>(16), kFloat, "VEC2", 2);
  return parts;
}

}  // namespace lkao::scene
