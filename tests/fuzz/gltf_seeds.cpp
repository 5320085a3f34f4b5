// Small glTF files with everything that the reader knows, changed at random places.
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/target.h"
#include "lut/random.h"
#include "scene/gltf_builder.h"
#include "scene/gltf_packing.h"

namespace lkao::tests {
namespace {

using nlohmann::json;
using scene::GltfBuilder;

// Nodes in a tree, one hidden; three instances; a strip beside a fan with texture coordinates, colours and holes.
GltfBuilder instanced_square() {
  GltfBuilder parts = scene::gltf_square({0, 1, 3, 2}, 5);
  const json node = {{"mesh", 0}, {"rotation", {0, 0, 1, 0}}, {"scale", {-1, 1, 2}}};
  parts.document["nodes"] = {{{"children", {1, 2}}, {"translation", {1, 2, 3}}}, node, node};
  parts.node(2)["extensions"]["KHR_node_visibility"]["visible"] = false;
  json& instances = parts.node(1)["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  instances["TRANSLATION"] = parts.add_values(std::vector<float>(9, 1.0f), scene::kFloat, "VEC3", 3);
  instances["ROTATION"] = parts.add_values(std::vector<std::int8_t>(12, 3), scene::kInt8, "VEC4", 4);
  json second = parts.primitive();
  second["mode"] = 6;
  second["material"] = 0;
  second["attributes"]["TEXCOORD_0"] = parts.add_values(std::vector<std::uint16_t>(8, 3), scene::kUint16, "VEC2", 2);
  second["attributes"]["COLOR_0"] = parts.add_values(std::vector<std::uint8_t>(16, 1), scene::kUint8, "VEC4", 4);
  const json moved = {{"offset", {1, 2}}, {"rotation", 3}, {"scale", {4, 5}}};
  const json texture = {{"index", 0}, {"extensions", {{"KHR_texture_transform", moved}}}};
  parts.document["materials"] = {
      {{"name", "a"},
       {"alphaMode", "MASK"},
       {"alphaCutoff", 0.25},
       {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.5}}, {"baseColorTexture", texture}}},
       {"normalTexture", texture}}};
  parts.document["images"] = {{{"bufferView", parts.add_view(std::string(8, 'a'))}}};
  parts.document["textures"] = {{{"source", 0}, {"sampler", 0}}};
  parts.document["samplers"] = {{{"wrapS", 33648}}};
  parts.document["meshes"][0]["primitives"].push_back(second);
  return parts;
}

// A skin of two joints, a morph target that is sparse, normals in bytes.
GltfBuilder skinned_square() {
  GltfBuilder parts = scene::gltf_square({0, 1, 2, 0, 2, 3});
  json& attributes = parts.primitive()["attributes"];
  attributes["JOINTS_0"] = parts.add_values(std::vector<std::uint8_t>(16, 1), scene::kUint8, "VEC4", 4);
  attributes["WEIGHTS_0"] = parts.add_values(std::vector<std::uint8_t>(16, 64), scene::kUint8, "VEC4", 4);
  attributes["NORMAL"] = parts.add_accessor(parts.add_view(std::string(16, '\1'), 4), scene::kInt8, 4, "VEC3");
  const std::size_t indices = parts.add_view(std::string("\1\3", 2));
  const std::size_t values = parts.add_view(std::string(24, '\2'));
  const std::size_t target = parts.document["accessors"].size();
  parts.document["accessors"].push_back({{"componentType", scene::kFloat},
                                         {"count", 4},
                                         {"type", "VEC3"},
                                         {"sparse",
                                          {{"count", 2},
                                           {"indices", {{"bufferView", indices}, {"componentType", scene::kUint8}}},
                                           {"values", {{"bufferView", values}}}}}});
  parts.primitive()["targets"] = {{{"POSITION", target}, {"NORMAL", target}}};
  parts.document["meshes"][0]["weights"] = {0.5};
  const std::size_t matrices = parts.add_values(std::vector<float>(32, 1.0f), scene::kFloat, "MAT4", 16);
  parts.document["nodes"] = {{{"mesh", 0}, {"skin", 0}}, {{"translation", {1, 0, 0}}}, {{"mesh", 0}, {"weights", {1}}}};
  parts.document["scenes"][0]["nodes"] = {0, 1, 2};
  parts.document["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", matrices}}};
  return parts;
}

const std::vector<GltfBuilder>& whole_files() {
  static const std::vector<GltfBuilder> files = {scene::gltf_cube(), instanced_square(), skinned_square(),
                                                 scene::draco_cube(), scene::meshopt_cube()};
  return files;
}

// What may stand in the place of a number, and anywhere; each behind a bar.
constexpr std::string_view kValues =
    "|0|1|2|3|-1|7|255|65535|4294967295|9007199254740992|1e300|1e-300|0.5|null|true|\"\"|[]|{}|[0]|{\"mesh\":0}"
    "|5120|5121|5122|5123|5125|5126|\"VEC3\"|\"data:;base64,AAAA\"";
constexpr std::string_view kPieces =
    "|\"bufferView\":0,|\"normalized\":true,|\"byteStride\":4,|\"byteOffset\":1,|\"count\":1,|,|:|%41|[[[[|{|}|0";

std::string_view random_piece(std::string_view pieces, lut::RandomStream& random) {
  const std::size_t at = pieces.rfind('|', random.next_below(pieces.size()));
  pieces.remove_prefix(at + 1);
  return pieces.substr(0, pieces.find('|'));
}

void change_text(std::string& text, lut::RandomStream& random) {
  const std::size_t anywhere = random.next_below(text.size());
  if (random.next_below(16) == 0) {
    text.replace(anywhere, random.next_below(4), random_piece(kPieces, random));
    return;
  }
  constexpr std::string_view kDigits = "0123456789";
  std::size_t at = text.find_first_of(":,[", anywhere);
  while (at + 1 < text.size() && kDigits.find(text[at + 1]) == kDigits.npos) at = text.find_first_of(":,[", at + 1);
  if (at >= text.size()) return;
  const std::size_t end = std::min(text.find_first_not_of(kDigits, at + 1), text.size());
  text.replace(at + 1, end - at - 1, random_piece(kValues, random));
}

void change_buffer(std::string& buffer, lut::RandomStream& random) {
  if (buffer.empty()) return;
  buffer[random.next_below(buffer.size())] = static_cast<char>(random.next_bits());
  if (random.next_below(32) == 0) buffer.resize(random.next_below(buffer.size() + 8));
}

}  // namespace

std::vector<std::uint8_t> bytes_of_seed(std::uint64_t seed) {
  lut::RandomStream random(seed);
  const GltfBuilder& whole = whole_files()[random.next_below(whole_files().size())];
  const bool is_binary = random.next_below(2) == 0;
  GltfBuilder parts = whole;
  for (std::uint64_t changes = random.next_below(6); changes > 0; --changes) change_buffer(parts.buffer, random);
  std::string text = is_binary ? parts.document.dump() : parts.gltf();
  for (std::uint64_t changes = random.next_below(4); changes > 0; --changes) change_text(text, random);
  if (is_binary) text = scene::glb_of({{"JSON", text}, {std::string("BIN\0", 4), parts.buffer}});
  if (random.next_below(16) == 0) text.resize(random.next_below(text.size() + 1));
  return {text.begin(), text.end()};
}

}  // namespace lkao::tests
