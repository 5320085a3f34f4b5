#include "scene/gltf_builder.h"

namespace lkao::scene {

namespace {

std::string raw_uint32(std::size_t n) {
  const auto number = static_cast<std::uint32_t>(n);
  std::string bytes(4, '\0');
  std::memcpy(bytes.data(), &number, 4);
  return bytes;
}

GltfBuilder make(const std::vector<glm::vec3>& positions, const std::vector<std::uint16_t>& indices) {
  GltfBuilder builder;
  builder.document = {{"asset", {{"version", "2.0"}}},
                      {"scene", 0},
                      {"scenes", {{{"nodes", {0}}}}},
                      {"nodes", {{{"mesh", 0}}}},
                      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
                      {"buffers", {{{"byteLength", 0}}}}};
  builder.add_values(positions, kFloat, "VEC3", 1);
  builder.add_values(indices, kUint16, "SCALAR", 1);
  return builder;
}

}  // namespace

std::size_t GltfBuilder::add_view(const std::string& bytes, std::size_t stride) {
  nlohmann::json view = {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}};
  if (stride != 0) view["byteStride"] = stride;
  document["bufferViews"].push_back(view);
  buffer += bytes;
  buffer.resize((buffer.size() + 3) / 4 * 4);
  document["buffers"][0]["byteLength"] = buffer.size();
  return document["bufferViews"].size() - 1;
}

std::size_t GltfBuilder::add_accessor(std::size_t view, int component_type, std::size_t count, const char* shape) {
  document["accessors"].push_back(
      {{"bufferView", view}, {"componentType", component_type}, {"count", count}, {"type", shape}});
  return document["accessors"].size() - 1;
}

std::string GltfBuilder::gltf() const {
  nlohmann::json whole = document;
  whole["buffers"][0]["uri"] = "data:application/octet-stream;base64," + to_base64(buffer);
  return whole.dump();
}

std::string GltfBuilder::glb() const {
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  return glb_of({{"JSON", text}, {std::string("BIN\0", 4), buffer}});
}

const std::vector<glm::vec3>& cube_corners() {
  static const std::vector<glm::vec3> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                                 {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  return corners;
}

const std::vector<std::uint16_t>& cube_indices() {
  static const std::vector<std::uint16_t> indices = {0, 3, 2, 0, 2, 1, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                                     2, 3, 7, 2, 7, 6, 1, 2, 6, 1, 6, 5, 0, 4, 7, 0, 7, 3};
  return indices;
}

GltfBuilder gltf_cube() { return make(cube_corners(), cube_indices()); }

GltfBuilder gltf_square(const std::vector<std::uint16_t>& indices, int mode) {
  GltfBuilder builder = make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, indices);
  builder.primitive()["mode"] = mode;
  return builder;
}

GltfBuilder gltf_leaf(const std::string& image) {
  GltfBuilder builder = gltf_square({0, 1, 2, 0, 2, 3});
  builder.primitive()["attributes"]["TEXCOORD_0"] =
      builder.add_values(std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0}, kFloat, "VEC2", 2);
  builder.primitive()["material"] = 0;
  builder.document["images"] = {{{"bufferView", builder.add_view(image)}, {"mimeType", "image/png"}}};
  builder.document["samplers"] = {{{"magFilter", 9728}}};
  builder.document["textures"] = {{{"source", 0}, {"sampler", 0}}};
  builder.document["materials"] = {
      {{"name", "leaf"}, {"alphaMode", "MASK"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  return builder;
}

std::string glb_of(const std::vector<Chunk>& chunks) {
  std::string content;
  for (const Chunk& chunk : chunks) content += raw_uint32(chunk.content.size()) + chunk.type + chunk.content;
  return "glTF" + raw_uint32(2) + raw_uint32(12 + content.size()) + content;
}

std::string to_base64(const std::string& bytes) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = i; k < i + 3; ++k)
      bits = bits << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : alphabet[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

}  // namespace lkao::scene
