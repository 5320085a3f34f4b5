#include "scene/formats/gltf/material_maps.h"

#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scene/formats/gltf/textures.h"

namespace lkao::scene::gltf {

namespace {

std::size_t number_of(TextureWrap wrap) {
  return wrap == TextureWrap::clamp ? 33071 : wrap == TextureWrap::mirror ? 33648 : 10497;
}

class MapWriter {
 public:
  MapWriter(Document& document, std::size_t map_count, int uv_set)
      : document_(document),
        root_(document.root()),
        map_count_(map_count),
        uv_set_(static_cast<std::size_t>(uv_set)),
        uv_name_(fmt::format("TEXCOORD_{}", uv_set)) {
    const std::size_t count = size_of_list(root_, "materials");
    has_plain_integers_.resize(count);
    lacking_.resize(count);
    find_primitives();
  }

  // The maps of materials that the file has.
  void add(const OcclusionMap& map) {
    const Value material = root_.at("materials").element(map.material);
    const std::string name = material.find("name") ? material.at("name").text() : material.place();
    const std::size_t texture =
        add_texture(map.png, "occlusion of " + name, fmt::format(".occlusion-{}.png", map.material),
                    wraps_of(root_, material, uv_set_));
    keep_for_others(map.material);
    JsonText& text = document_.text();
    const JsonText::Place place = document_.entry("materials", map.material);
    text.set(place, "occlusionTexture", texture_info(texture, map.material));
    if (!map.is_packed) return;
    // What is said of the texture besides its number stays.
    const std::optional<JsonText::Place> looks = text.find(place, "pbrMetallicRoughness");
    const std::optional<JsonText::Place> other = looks ? text.find(*looks, "metallicRoughnessTexture") : std::nullopt;
    if (!other) throw std::invalid_argument(fmt::format("with_maps: material {} has no packed image", map.material));
    text.set(*other, "index", std::to_string(texture));
  }

  // That of all that has no material: it gets one.
  void add_material(const OcclusionMap& map) {
    const std::size_t texture = add_texture(map.png, "occlusion", ".occlusion.png", {});
    const std::size_t material =
        document_.add("materials", "{\"occlusionTexture\":" + joined(members_of_info(texture)) + "}");
    for (const auto& [mesh, primitive] : bare_) set_material(mesh, primitive, material);
  }

 private:
  using Place = std::pair<std::size_t, std::size_t>;  // mesh, primitive

  void find_primitives() {
    for (std::size_t m = 0; m < size_of_list(root_, "meshes"); ++m) {
      const Value primitives = root_.at("meshes").element(m).at("primitives");
      for (std::size_t p = 0; p < primitives.size(); ++p) sort_in({m, p}, primitives.element(p));
    }
  }

  void sort_in(const Place& place, const Value& primitive) {
    const std::optional<Value> attributes = primitive.find("attributes");
    const std::optional<Value> uvs = attributes ? attributes->find(uv_name_.c_str()) : std::nullopt;
    const std::optional<Value> material = primitive.find("material");
    if (!material) {
      if (uvs) bare_.push_back(place);
      return;
    }
    item_of_list(root_, "materials", *material);
    if (!uvs) {
      lacking_[material->count()].push_back(place);
    } else if (has_integers(*uvs)) {
      has_plain_integers_[material->count()] = true;
    }
  }

  bool has_integers(const Value& index) const {
    constexpr std::size_t kFloat = 5126;
    const Value accessor = item_of_list(root_, "accessors", index);
    const std::optional<Value> normalized = accessor.find("normalized");
    return accessor.at("componentType").count() != kFloat && !(normalized && normalized->boolean());
  }

  // Primitives without these texture coordinates have no place on the map: a copy of the material is for them.
  void keep_for_others(std::size_t material) {
    if (lacking_[material].empty()) return;
    const std::size_t copy =
        document_.add("materials", std::string(document_.text().text_of(document_.entry("materials", material))));
    for (const auto& [mesh, primitive] : lacking_[material]) set_material(mesh, primitive, copy);
  }

  void set_material(std::size_t mesh, std::size_t primitive, std::size_t material) {
    JsonText& text = document_.text();
    const JsonText::Place primitives = *text.find(document_.entry("meshes", mesh), "primitives");
    text.set(text.element(primitives, primitive), "material", std::to_string(material));
  }

  std::size_t add_texture(const std::string& png, const std::string& name, const std::string& ending,
                          const TextureWraps& wraps) {
    const std::size_t image = document_.add_png(png, name, map_count_ == 1 ? ".occlusion.png" : ending);
    return document_.add("textures", fmt::format(R"({{"sampler":{},"source":{}}})", sampler(wraps), image));
  }

  // Interpolated, with mip levels; one for all that wrap alike.
  std::size_t sampler(const TextureWraps& wraps) {
    const auto [entry, is_new] = samplers_.try_emplace({number_of(wraps.u), number_of(wraps.v)});
    if (is_new) {
      entry->second =
          document_.add("samplers", fmt::format(R"({{"magFilter":9729,"minFilter":9987,"wrapS":{},"wrapT":{}}})",
                                                entry->first[0], entry->first[1]));
    }
    return entry->second;
  }

  // What else is said of the texture that was there stays; where it lies, if that is where the new one lies.
  std::string texture_info(std::size_t texture, std::size_t material) const {
    std::vector<std::string> members = members_of_info(texture);
    std::vector<std::string> extensions;
    const Value values = root_.at("materials").element(material);
    if (const auto transform = occlusion_transform(values, uv_set_, has_plain_integers_[material])) {
      extensions.push_back("\"KHR_texture_transform\":" + spelled(*transform));
    }
    const JsonText& text = document_.text();
    const auto add = [](std::vector<std::string> more, std::vector<std::string>& list) {
      list.insert(list.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    };
    if (const auto old = text.find(document_.entry("materials", material), "occlusionTexture")) {
      add(text.members_but(*old, {"index", "texCoord", "extensions"}), members);
      if (const auto others = text.find(*old, "extensions")) {
        add(text.members_but(*others, {"KHR_texture_transform"}), extensions);
      }
    }
    if (!extensions.empty()) members.push_back("\"extensions\":" + joined(extensions));
    return joined(members);
  }

  std::vector<std::string> members_of_info(std::size_t texture) const {
    std::vector<std::string> members = {fmt::format(R"("index":{})", texture)};
    if (uv_set_ != 0) members.push_back(fmt::format(R"("texCoord":{})", uv_set_));
    return members;
  }

  static std::string spelled(const Value& transform) {
    std::vector<std::string> members;
    for (const char* const key : {"offset", "scale"}) {
      std::array<double, 2> numbers{};
      if (!transform.find(key)) continue;
      transform.at(key).numbers(numbers);
      members.push_back(fmt::format(R"("{}":[{},{}])", key, numbers[0], numbers[1]));
    }
    if (const auto rotation = transform.find("rotation")) {
      members.push_back(fmt::format(R"("rotation":{})", rotation->number()));
    }
    return joined(members);
  }

  Document& document_;
  Value root_;
  std::size_t map_count_;
  std::size_t uv_set_;
  std::string uv_name_;
  std::vector<Place> bare_;                  // primitives without a material
  std::vector<std::vector<Place>> lacking_;  // by material: primitives without these texture coordinates
  std::vector<bool> has_plain_integers_;     // by material: the texture coordinates of some primitive
  std::map<std::array<std::size_t, 2>, std::size_t> samplers_;
};

}  // namespace

namespace {

std::optional<Value> texture_of(const std::optional<Value>& object, const char* key) {
  return object ? object->find(key) : std::nullopt;
}

// The number of the image that a texture shows; extensions may have others beside it.
std::optional<std::size_t> image_of(const Value& root, const std::optional<Value>& info) {
  if (!info) return std::nullopt;
  const Value texture = item_of_list(root, "textures", info->at("index"));
  const std::optional<Value> source = texture.find("source");
  if (!source || texture.find("extensions")) return std::nullopt;
  item_of_list(root, "images", *source);
  return source->count();
}

bool lie_alike(const Value& a, const Value& b, std::size_t uv_set) {
  if (uv_set_of(a) != uv_set || uv_set_of(b) != uv_set) return false;
  const std::optional<Value> moved = a.extension("KHR_texture_transform");
  const std::optional<Value> other = b.extension("KHR_texture_transform");
  if (!moved && !other) return true;
  return moved && other && UvTransform(*moved) == UvTransform(*other);
}

// Whether any texture of the material shows the image.
bool shows(const Value& root, const Value& material, std::size_t image) {
  const std::optional<Value> looks = material.find("pbrMetallicRoughness");
  for (const std::optional<Value>& info :
       {texture_of(material, "occlusionTexture"), texture_of(material, "normalTexture"),
        texture_of(material, "emissiveTexture"), texture_of(looks, "baseColorTexture"),
        texture_of(looks, "metallicRoughnessTexture")}) {
    if (image_of(root, info) == image) return true;
  }
  return false;
}

}  // namespace

std::optional<std::size_t> find_packed_image(const Value& root, std::size_t material, int uv_set) {
  if (material >= size_of_list(root, "materials")) return std::nullopt;
  const Value object = root.at("materials").element(material);
  const std::optional<Value> occlusion = object.find("occlusionTexture");
  const std::optional<Value> looks = texture_of(object.find("pbrMetallicRoughness"), "metallicRoughnessTexture");
  const std::optional<std::size_t> image = image_of(root, occlusion);
  if (!image || image != image_of(root, looks) || !lie_alike(*occlusion, *looks, static_cast<std::size_t>(uv_set))) {
    return std::nullopt;
  }
  for (std::size_t other = 0; other < size_of_list(root, "materials"); ++other) {
    if (other != material && shows(root, root.at("materials").element(other), *image)) return std::nullopt;
  }
  return image;
}

void add_maps(Document& document, std::span<const OcclusionMap> maps, int uv_set) {
  MapWriter writer(document, maps.size(), uv_set);
  const std::size_t material_count = size_of_list(document.root(), "materials");
  std::set<std::uint32_t> done;
  for (const OcclusionMap& map : maps) {
    if (map.material != kNoMaterial && map.material >= material_count) {
      throw std::invalid_argument(
          fmt::format("with_maps: maps has one of material {}, there are {}", map.material, material_count));
    }
    if (!done.insert(map.material).second) {
      throw std::invalid_argument(fmt::format("with_maps: maps has two of material {}", map.material));
    }
    if (map.material == kNoMaterial) {
      writer.add_material(map);
    } else {
      writer.add(map);
    }
  }
}

}  // namespace lkao::scene::gltf
