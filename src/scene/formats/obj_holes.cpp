#include "scene/formats/obj_holes.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "scene/formats/text.h"

namespace lkao::scene {

void ObjHoles::add(const ObjMaterial& material, std::uint32_t number, std::size_t triangle_count) {
  const std::string name = printable(material.name);
  if (!decode_) {
    cut_outs_.push_back({name, triangle_count});
    return;
  }
  if (triangle_count == 0) return;
  HoleMaterial holes{.factor = material.opacity};
  if (!material.map.empty()) {
    if (std::shared_ptr<const AlphaImage> image = image_of(material)) {
      const TextureWrap wrap = material.clamps ? TextureWrap::clamp : TextureWrap::repeat;
      holes.texture = AlphaTexture{std::move(image), {wrap, wrap}};
    }
  }
  if (!holes.texture && holes.factor == 1) return;
  materials_.emplace(number, std::move(holes));
  cut_outs_.push_back({name, triangle_count, CutOut::Kind::blend});
}

// Null where there is none to read.
std::shared_ptr<const AlphaImage> ObjHoles::image_of(const ObjMaterial& material) {
  const auto [entry, is_new] = images_.try_emplace(material.map);
  if (!is_new) return entry->second;
  const std::string name = printable(material.map);
  const auto add_fault = [&](const std::string& fault) {
    faults_.push_back(fmt::format("{}: it counts as opaque, in material \"{}\"", fault, printable(material.name)));
  };
  const std::optional<std::string> bytes = read_beside_(material.map);
  if (!bytes) {
    add_fault(fmt::format("cannot read '{}': there is no such file", name));
    return nullptr;
  }
  try {
    AlphaImage image = decode_(name, *bytes, AlphaOf::alpha_or_grey);
    if (image.size() == 0) throw std::runtime_error(name + " has no pixels");
    image.least = *std::min_element(image.alphas.begin(), image.alphas.end());
    entry->second = std::make_shared<const AlphaImage>(std::move(image));
  } catch (const std::runtime_error& error) {
    add_fault(error.what());
  }
  return entry->second;
}

std::shared_ptr<const Holes> ObjHoles::of(const FileMesh& mesh) const {
  Holes holes;
  std::map<std::uint32_t, std::uint32_t> places;  // of materials, by number
  for (const auto& [number, material] : materials_) {
    places[number] = static_cast<std::uint32_t>(holes.materials.size());
    holes.materials.push_back(material);
  }
  holes.numbers.assign(mesh.triangles.size(), kWhole);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto place = places.find(mesh.materials[t]);
    if (place == places.end()) continue;
    HoleTriangle triangle{.material = place->second};
    for (int i = 0; i < 3 && !mesh.uv_corners.empty(); ++i) {
      const std::uint32_t number = mesh.uv_corners[t][i];
      if (number < mesh.uvs.size()) triangle.uvs[static_cast<std::size_t>(i)] = mesh.uvs[number];
    }
    holes.numbers[t] = static_cast<std::uint32_t>(holes.triangles.size());
    holes.triangles.push_back(triangle);
  }
  return std::make_shared<const Holes>(std::move(holes));
}

void ObjHoles::describe(Contents& contents) {
  constexpr std::size_t kNamedCount = 3;
  for (std::size_t i = 0; i < std::min(faults_.size(), kNamedCount); ++i) contents.remarks.push_back(faults_[i]);
  if (faults_.size() > kNamedCount) {
    contents.remarks.push_back(
        fmt::format("{} more images cannot be read, and count as opaque", faults_.size() - kNamedCount));
  }
  add_cut_outs(std::move(cut_outs_), contents);
}

}  // namespace lkao::scene
