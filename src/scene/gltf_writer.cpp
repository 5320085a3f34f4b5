#include "scene/gltf_writer.h"

#include <cstring>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "scene/formats/file_bytes.h"
#include "scene/formats/gltf/buffers.h"
#include "scene/formats/gltf/container.h"
#include "scene/formats/gltf/document.h"
#include "scene/formats/gltf/images.h"
#include "scene/formats/gltf/material_maps.h"
#include "scene/formats/gltf/parse.h"
#include "scene/formats/gltf/requirements.h"
#include "scene/formats/gltf/uri.h"
#include "scene/formats/gltf/vertex_values.h"
#include "scene/occlusion_colour.h"

namespace lkao::scene {

namespace {

void append_floats(std::initializer_list<float> floats, std::string& bytes) {
  for (const float number : floats) {
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    bytes.append(raw, sizeof number);
  }
}

constexpr gltf::AttributeCoding kOcclusion{"_OCCLUSION", "SCALAR", 4,
                                           [](float value, std::string& bytes) { append_floats({value}, bytes); }};

constexpr gltf::AttributeCoding kColour{"COLOR_0", "VEC3", 12, [](float value, std::string& bytes) {
                                          const auto grey = static_cast<float>(grey_of(value, ColourCoding::linear));
                                          append_floats({grey, grey, grey}, bytes);
                                        }};

// The file's name in front of a fault.
template <typename Work>
auto naming(const std::string& path, const Work& work) {
  try {
    return work();
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

// Decoders of Draco give vertices one order; what stands unpacked beside has another.
void check_primitive(const gltf::Value& root, const gltf::Value& primitive, GltfAttribute attribute) {
  const std::optional<gltf::Value> attributes = primitive.find("attributes");
  if (!attributes) return;
  if (attribute == GltfAttribute::colour && attributes->find("COLOR_0")) {
    throw std::runtime_error(
        fmt::format("{} has colours of vertices already, which occlusion would replace", primitive.place()));
  }
  const std::optional<gltf::Value> position = attributes->find("POSITION");
  if (position && primitive.extension("KHR_draco_mesh_compression") &&
      gltf::item_of_list(root, "accessors", *position).find("bufferView")) {
    throw std::runtime_error(
        fmt::format("{} is packed by Draco, and there unpacked as well: values of vertices fit one of the two alone",
                    primitive.place()));
  }
}

// What was read before may be another file by now.
void check_block(const gltf::Value& root, const VertexBlock& block) {
  bool is_there = block.node < gltf::size_of_list(root, "nodes") && block.mesh < gltf::size_of_list(root, "meshes");
  for (const std::uint32_t number : block.primitives) {
    if (!is_there) break;
    const gltf::Value primitives = root.at("meshes").element(block.mesh).at("primitives");
    is_there = number < primitives.size() && primitives.element(number).find("attributes");
  }
  if (!is_there) throw std::runtime_error("it has changed since it was read");
}

void remark_on_instances(const std::vector<gltf::ShownValues>& nodes, std::vector<std::string>& remarks) {
  std::size_t count = 0;
  for (const gltf::ShownValues& node : nodes) count += node.instance_count > 1 ? 1 : 0;
  if (count == 0) return;
  remarks.push_back(fmt::format("{} {} instances of one mesh, which get their mean occlusion", count,
                                count == 1 ? "node shows" : "nodes show"));
}

}  // namespace

struct GltfFile::Parts {
  std::string path, output;
  FileBytes bytes;
  gltf::Container container;
  nlohmann::json json;

  gltf::Value root() const { return {json, ""}; }
  // Those of an image; none where its file is missing.
  std::string bytes_of(const gltf::Value& image) const {
    if (const std::optional<gltf::Value> view = image.find("bufferView")) {
      gltf::Buffers buffers(root(), container.binary, path, bytes.size);
      return std::string(buffers.view(*view).bytes);
    }
    return gltf::bytes_of_uri(path, image.at("uri").text());
  }
  gltf::Document document() const { return {container, root(), path, output}; }
};

GltfFile::GltfFile(const std::string& path, const std::string& output) : parts_(std::make_unique<Parts>()) {
  naming(path, [&] {
    parts_->path = path;
    parts_->output = output;
    parts_->bytes = read_file(path);
    parts_->container = gltf::open_container(parts_->bytes.view());
    parts_->json = gltf::parse(parts_->container.json);
    gltf::check_requirements(parts_->root());
  });
}

GltfFile::~GltfFile() = default;

std::vector<std::string> GltfFile::neighbours() const {
  std::vector<std::string> paths;
  const gltf::Value root = parts_->root();
  for (const char* list : {"buffers", "images"}) {
    for (std::size_t i = 0; i < gltf::size_of_list(root, list); ++i) {
      const std::optional<gltf::Value> uri = root.at(list).element(i).find("uri");
      if (uri && gltf::is_relative_uri(uri->text())) paths.push_back(gltf::resolve_uri(parts_->path, uri->text()));
    }
  }
  return paths;
}

void GltfFile::check_vertices(GltfAttribute attribute) const {
  naming(parts_->path, [&] {
    const gltf::Value root = parts_->root();
    for (std::size_t m = 0; m < gltf::size_of_list(root, "meshes"); ++m) {
      const gltf::Value primitives = root.at("meshes").element(m).at("primitives");
      for (std::size_t p = 0; p < primitives.size(); ++p) check_primitive(root, primitives.element(p), attribute);
    }
  });
}

GltfOutput GltfFile::with_vertices(const Contents& contents, std::span<const float> occlusion,
                                   GltfAttribute attribute) const {
  std::size_t vertex_count = 0;
  for (const VertexBlock& block : contents.vertex_blocks) vertex_count += block.vertex_count;
  if (occlusion.size() != vertex_count) {
    throw std::invalid_argument(fmt::format("with_vertices: occlusion has {} entries, the scene has {} vertices",
                                            occlusion.size(), vertex_count));
  }
  check_vertices(attribute);
  return naming(parts_->path, [&] {
    for (const VertexBlock& block : contents.vertex_blocks) check_block(parts_->root(), block);
    const std::vector<gltf::ShownValues> nodes = gltf::values_of_nodes(contents.vertex_blocks, occlusion);
    gltf::Document document = parts_->document();
    gltf::add_attribute(document, nodes, attribute == GltfAttribute::colour ? kColour : kOcclusion);
    GltfOutput output = std::move(document).finish();
    remark_on_instances(nodes, output.remarks);
    return output;
  });
}

std::optional<PackedImage> GltfFile::packed_image(std::uint32_t material, int uv_set) const {
  return naming(parts_->path, [&]() -> std::optional<PackedImage> {
    const gltf::Value root = parts_->root();
    const std::optional<std::size_t> number = gltf::find_packed_image(root, material, uv_set);
    if (!number) return std::nullopt;
    const gltf::Value image = root.at("images").element(*number);
    PackedImage packed{parts_->path + ": " + image.place(), parts_->bytes_of(image)};
    if (gltf::image_type_of(packed.bytes).empty()) return std::nullopt;
    return packed;
  });
}

GltfOutput GltfFile::with_maps(std::span<const OcclusionMap> maps, int uv_set) const {
  if (uv_set < 0) throw std::invalid_argument(fmt::format("with_maps: uv_set is {}, which is negative", uv_set));
  return naming(parts_->path, [&] {
    gltf::Document document = parts_->document();
    gltf::add_maps(document, maps, uv_set);
    return std::move(document).finish();
  });
}

}  // namespace lkao::scene
