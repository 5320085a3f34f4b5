#include "scene/formats/obj_holes.h"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene/formats/text.h"

namespace lkao::scene {

glm::vec2 ObjHoles::Look::shown_at(const glm::vec2& uv) const {
  if (scale == glm::dvec2(1) && offset == glm::dvec2(0)) return uv;
  return from_lower_left(scale.x * double{uv.x} + offset.x, scale.y * (1 - double{uv.y}) + offset.y);
}

void ObjHoles::add(const ObjMaterial& material, std::uint32_t number, std::size_t triangle_count) {
  const std::string name = printable(material.name);
  if (!images_.is_reading()) {
    cut_outs_.push_back({name, triangle_count});
    return;
  }
  if (triangle_count == 0) return;
  std::shared_ptr<const AlphaImage> image = material.map.name.empty() ? nullptr : image_of(material);
  if (!image && material.opacity == 1) return;
  Look& look = materials_[number];
  look.material.factor = material.opacity;
  look.scale = material.map.scale;
  look.offset = material.map.offset;
  if (image) {
    const TextureWrap wrap = material.map.clamps ? TextureWrap::clamp : TextureWrap::repeat;
    look.material.texture.emplace(AlphaTexture{std::move(image), {wrap, wrap}});
    note_ignored(material);
  }
  cut_outs_.push_back({name, triangle_count, CutOut::Kind::blend});
}

void ObjHoles::note_ignored(const ObjMaterial& material) {
  if (material.map.ignored.empty()) return;
  if (ignored_count_++ == 0) {
    ignored_ =
        fmt::format("map_d: {} of material \"{}\"", fmt::join(material.map.ignored, ", "), printable(material.name));
  }
}

// Null where there is none to read.
std::shared_ptr<const AlphaImage> ObjHoles::image_of(const ObjMaterial& material) {
  const auto [entry, is_new] = known_images_.try_emplace(material.map.name);
  if (!is_new) return entry->second;
  const std::string name = printable(material.map.name);
  entry->second = images_.read(name, printable(material.name), AlphaOf::alpha_or_grey, [&] {
    std::optional<std::string> bytes = read_beside_(material.map.name);
    if (!bytes) throw std::runtime_error(fmt::format("cannot read '{}': there is no such file", name));
    return *std::move(bytes);
  });
  return entry->second;
}

std::shared_ptr<const Holes> ObjHoles::of(const FileMesh& mesh) const {
  Holes holes;
  std::map<std::uint32_t, std::uint32_t> places;  // of materials, by number
  std::vector<const Look*> looks;                 // by place
  holes.materials.reserve(materials_.size());
  looks.reserve(materials_.size());
  for (const auto& [number, look] : materials_) {
    places[number] = static_cast<std::uint32_t>(holes.materials.size());
    holes.materials.push_back(look.material);
    looks.push_back(&look);
  }
  holes.numbers.assign(mesh.triangles.size(), kWhole);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto place = places.find(mesh.materials[t]);
    if (place == places.end()) continue;
    HoleTriangle triangle{.material = place->second};
    for (int i = 0; i < 3 && !mesh.uv_corners.empty(); ++i) {
      const std::uint32_t number = mesh.uv_corners[t][i];
      if (number < mesh.uvs.size()) {
        triangle.uvs[static_cast<std::size_t>(i)] = looks[place->second]->shown_at(mesh.uvs[number]);
      }
    }
    holes.numbers[t] = static_cast<std::uint32_t>(holes.triangles.size());
    holes.triangles.push_back(triangle);
  }
  return std::make_shared<const Holes>(std::move(holes));
}

void ObjHoles::describe(Contents& contents) {
  for (std::string& remark : images_.remarks()) contents.remarks.push_back(std::move(remark));
  if (ignored_count_ > 0) {
    const std::string more = ignored_count_ > 1 ? fmt::format(" and of {} more", ignored_count_ - 1) : std::string();
    contents.remarks.push_back(ignored_ + more + " are not obeyed");
  }
  add_cut_outs(std::move(cut_outs_), contents);
}

}  // namespace lkao::scene
