#include "scene/formats/gltf/holes.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "scene/formats/gltf/images.h"
#include "scene/formats/gltf/textures.h"
#include "scene/formats/gltf/uri.h"
#include "scene/formats/text.h"

namespace lkao::scene::gltf {

namespace {

// What makes the colour of a material, under the names of its two kinds.
struct BaseColour {
  std::optional<Value> factor, texture;
};

BaseColour base_colour_of(const Value& material) {
  const auto of = [](const std::optional<Value>& looks, const char* factor, const char* texture) {
    return looks ? BaseColour{looks->find(factor), looks->find(texture)} : BaseColour{};
  };
  const std::optional<Value> glossy = material.extension("KHR_materials_pbrSpecularGlossiness");
  return glossy ? of(glossy, "diffuseFactor", "diffuseTexture")
                : of(material.find("pbrMetallicRoughness"), "baseColorFactor", "baseColorTexture");
}

// The number of its image: one that everything can read where there is a choice.
std::optional<Value> source_of(const Value& texture) {
  std::optional<Value> source = texture.find("source");
  for (const char* const name : {"EXT_texture_webp", "EXT_texture_avif", "KHR_texture_basisu", "MSFT_texture_dds"}) {
    if (source) break;
    if (const std::optional<Value> extension = texture.extension(name)) source = extension->find("source");
  }
  return source;
}

// Nothing of it is missing.
bool is_whole(const HoleTriangle& triangle, const HoleMaterial& material) {
  const double own =
      material.factor * static_cast<double>(*std::min_element(triangle.alphas.begin(), triangle.alphas.end()));
  const double needed = material.cut_off.value_or(1);
  if (!material.texture || !(own > 0)) return own >= needed;
  const auto& [a, b, c] = triangle.uvs;
  return material.texture->is_at_least(needed / own, glm::dvec2(glm::min(a, glm::min(b, c))),
                                       glm::dvec2(glm::max(a, glm::max(b, c))));
}

// One a vertex; opaque where colours have none.
std::vector<float> alphas_of(const Primitive& primitive) {
  std::vector<float> alphas(primitive.vertex_count(), 1.0f);
  if (!primitive.has("COLOR_0") || primitive.shape_of("COLOR_0") != "VEC4") return alphas;
  const std::vector<glm::dvec4> colours = primitive.vec4s("COLOR_0");
  std::transform(colours.begin(), colours.end(), alphas.begin(),
                 [](const glm::dvec4& colour) { return static_cast<float>(colour.a); });
  return alphas;
}

// One a vertex; zero, as where viewers have nothing to read, where there are none.
std::vector<glm::vec2> uvs_of(const Primitive& primitive, const Value& texture) {
  std::vector<glm::vec2> uvs(primitive.vertex_count(), glm::vec2(0.0f));
  const std::string name = fmt::format("TEXCOORD_{}", uv_set_of(texture));
  if (primitive.has(name.c_str())) {
    const std::vector<glm::dvec2> values = primitive.vec2s(name.c_str());
    std::copy(values.begin(), values.end(), uvs.begin());
  }
  if (const std::optional<Value> extension = texture.extension("KHR_texture_transform")) {
    std::transform(uvs.begin(), uvs.end(), uvs.begin(), UvTransform(*extension));
  }
  return uvs;
}

}  // namespace

std::string name_of(const Value& material) {
  const std::optional<Value> name = material.find("name");
  return name ? printable(name->text()) : material.place();
}

AlphaMode alpha_mode_of(const Value& material) {
  const std::optional<Value> mode = material.find("alphaMode");
  if (!mode) return AlphaMode::opaque;
  return mode->text() == "MASK" ? AlphaMode::mask : mode->text() == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
}

HoleReader::HoleReader(Value root, Buffers& buffers, std::string path, const DecodeAlpha& decode)
    : root_(std::move(root)), buffers_(buffers), path_(std::move(path)), read_images_(decode) {}

std::vector<HoleTriangle> HoleReader::read(const Primitive& primitive, const std::vector<glm::uvec3>& triangles) {
  const std::optional<Value> index = primitive.json().find("material");
  if (!is_reading() || !index || index->count() >= size_of_list(root_, "materials")) return {};
  const Value material = item_of_list(root_, "materials", *index);
  if (alpha_mode_of(material) == AlphaMode::opaque) return {};
  const Look& look = look_of(material, index->count());
  const std::vector<float> alphas = alphas_of(primitive);
  const std::vector<glm::vec2> uvs = look.texture ? uvs_of(primitive, *look.texture) : std::vector<glm::vec2>();
  std::vector<HoleTriangle> holes(triangles.size(), {.material = look.number});
  std::size_t whole_count = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t vertex = triangles[t][static_cast<int>(i)];
      holes[t].alphas[i] = alphas[vertex];
      if (look.texture) holes[t].uvs[i] = uvs[vertex];
    }
    if (!is_whole(holes[t], materials_[look.number])) continue;
    holes[t].material = kWhole;
    ++whole_count;
  }
  if (whole_count == holes.size()) holes.clear();
  return holes;
}

const HoleReader::Look& HoleReader::look_of(const Value& material, std::size_t number) {
  const auto known = looks_.find(number);
  if (known != looks_.end()) return known->second;
  HoleMaterial holes;
  if (alpha_mode_of(material) == AlphaMode::mask) {
    const std::optional<Value> cut_off = material.find("alphaCutoff");
    holes.cut_off = cut_off ? cut_off->number() : 0.5;
  }
  const BaseColour colour = base_colour_of(material);
  if (colour.factor) {
    double factor[4];
    colour.factor->numbers(factor);
    holes.factor = factor[3];
  }
  if (colour.texture) holes.texture = open_texture(*colour.texture, name_of(material));
  const Look look{static_cast<std::uint32_t>(materials_.size()), holes.texture ? colour.texture : std::nullopt};
  materials_.push_back(std::move(holes));
  return looks_.emplace(number, look).first->second;
}

std::optional<AlphaTexture> HoleReader::open_texture(const Value& info, const std::string& material) {
  const Value texture = item_of_list(root_, "textures", info.at("index"));
  std::shared_ptr<const AlphaImage> image = image_of(texture, material);
  if (!image) return std::nullopt;
  return AlphaTexture{std::move(image), wraps_of_texture(root_, info), is_smooth(root_, info)};
}

// Null where there is none to read.
std::shared_ptr<const AlphaImage> HoleReader::image_of(const Value& texture, const std::string& material) {
  const std::optional<Value> source = source_of(texture);
  if (!source) return nullptr;
  const Value image = item_of_list(root_, "images", *source);
  const auto [entry, is_new] = images_.try_emplace(source->count());
  if (is_new) entry->second = decode(image, material);
  return entry->second;
}

// Null where it cannot be decoded.
std::shared_ptr<const AlphaImage> HoleReader::decode(const Value& image, const std::string& material) {
  const std::optional<Value> uri = image.find("uri");
  const std::string name = uri && !is_data_uri(uri->text()) ? printable(uri->text()) : image.place();
  return read_images_.read(name, material, AlphaOf::alpha, [&] { return bytes_of(image, name); });
}

std::string HoleReader::bytes_of(const Value& image, const std::string& name) {
  const std::optional<Value> uri = image.find("uri");
  try {
    return uri ? read_uri(path_, uri->text()) : std::string(buffers_.view(image.at("bufferView")).bytes);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("cannot read '{}': {}", name, error.what()));
  }
}

}  // namespace lkao::scene::gltf
