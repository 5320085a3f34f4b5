#include "scene/gltf_packing.h"

#include <array>
#include <stdexcept>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

namespace lkao::scene {

namespace {

std::string draco_bytes(std::uint32_t& position_id, std::uint32_t& normal_id) {
  const std::size_t face_count = cube_indices().size() / 3;
  draco::TriangleSoupMeshBuilder soup;
  soup.Start(static_cast<int>(face_count));
  const int position = soup.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int normal = soup.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
  for (std::size_t t = 0; t < face_count; ++t) {
    std::array<glm::vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = cube_corners()[cube_indices()[3 * t + k]];
    const draco::FaceIndex face(static_cast<std::uint32_t>(t));
    soup.SetAttributeValuesForFace(position, face, &corners[0], &corners[1], &corners[2]);
    const glm::vec3 up(0, 0, 1);
    soup.SetAttributeValuesForFace(normal, face, &up, &up, &up);
  }
  const std::unique_ptr<draco::Mesh> mesh = soup.Finalize();
  position_id = mesh->attribute(position)->unique_id();
  normal_id = mesh->attribute(normal)->unique_id();
  draco::Encoder encoder;
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
  draco::EncoderBuffer buffer;
  if (!encoder.EncodeMeshToBuffer(*mesh, &buffer).ok()) throw std::runtime_error("Draco packs no cube");
  return {buffer.data(), buffer.size()};
}

}  // namespace

GltfBuilder draco_cube() {
  std::uint32_t position = 0;
  std::uint32_t normal = 0;
  const std::string bytes = draco_bytes(position, normal);
  GltfBuilder parts = gltf_cube();
  parts.buffer.clear();
  parts.document["bufferViews"] = nlohmann::json::array();
  for (nlohmann::json& accessor : parts.document["accessors"]) accessor.erase("bufferView");
  parts.document["accessors"].push_back(parts.document["accessors"][0]);
  parts.primitive()["attributes"]["NORMAL"] = 2;
  parts.primitive()["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", parts.add_view(bytes)}, {"attributes", {{"POSITION", position}, {"NORMAL", normal}}}};
  parts.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return parts;
}

std::string pack_vertices(const std::string& bytes, std::size_t stride) {
  const std::size_t count = bytes.size() / stride;
  std::string packed(meshopt_encodeVertexBufferBound(count, stride), '\0');
  packed.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(packed.data()), packed.size(), bytes.data(),
                                           count, stride));
  return packed;
}

void pack_view(GltfBuilder& builder, std::size_t view, const std::string& packed, std::size_t count, std::size_t stride,
               const char* mode, const char* filter) {
  const std::size_t offset = builder.buffer.size();
  builder.buffer += packed;
  builder.buffer.resize((builder.buffer.size() + 3) / 4 * 4);
  builder.document["buffers"][0]["byteLength"] = builder.buffer.size();
  nlohmann::json& json = builder.document["bufferViews"][view];
  json = {{"buffer", 1}, {"byteLength", count * stride}};
  if (std::string(mode) == "ATTRIBUTES") json["byteStride"] = stride;
  json["extensions"]["EXT_meshopt_compression"] = {
      {"buffer", 0},  {"byteOffset", offset}, {"byteLength", packed.size()}, {"byteStride", stride}, {"count", count},
      {"mode", mode}, {"filter", filter}};
}

GltfBuilder meshopt_cube() {
  GltfBuilder parts = gltf_cube();
  parts.buffer.clear();
  parts.document["buffers"].push_back(
      {{"byteLength", 1000}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  pack_view(parts, 0, pack_vertices(bytes_of(cube_corners()), 12), 8, 12, "ATTRIBUTES");
  const std::vector<unsigned> indices(cube_indices().begin(), cube_indices().end());
  std::string packed(meshopt_encodeIndexBufferBound(indices.size(), 8), '\0');
  packed.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(packed.data()), packed.size(),
                                          indices.data(), indices.size()));
  pack_view(parts, 1, packed, indices.size(), 2, "TRIANGLES");
  parts.document["extensionsRequired"] = {"EXT_meshopt_compression"};
  return parts;
}

}  // namespace lkao::scene
