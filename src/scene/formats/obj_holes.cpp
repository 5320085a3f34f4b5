#include "scene/formats/obj_holes.h"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "scene/formats/text.h"

namespace lkao::scene {

void ObjHoles::add(const ObjMaterial& material, std::uint32_t number, std::size_t triangle_count) {
  const std::string name = printable(material.name);
  if (!images_.is_reading()) {
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
  const auto [entry, is_new] = known_images_.try_emplace(material.map);
  if (!is_new) return entry->second;
  const std::string name = printable(material.map);
  entry->second = images_.read(name, printable(material.name), AlphaOf::alpha_or_grey, [&] {
    std::optional<std::string> bytes = read_beside_(material.map);
    if (!bytes) throw std::runtime_error(fmt::format("cannot read '{}': there is no such file", name));
    return *std::move(bytes);
  });
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
  for (std::string& remark : images_.remarks()) contents.remarks.push_back(std::move(remark));
  add_cut_outs(std::move(cut_outs_), contents);
}

}  // namespace lkao::scene
