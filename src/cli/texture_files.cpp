#include "cli/texture_files.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "cli/gltf_map.h"
#include "cli/gltf_output.h"
#include "image/image.h"

namespace lkao::cli {
namespace {

namespace fs = std::filesystem;

float visibility_of(float occlusion, const TextureSettings& settings) {
  if (std::isnan(occlusion)) return 1;
  if (settings.strength == 1 && settings.contrast == 1) return 1 - occlusion;
  const double changed = settings.strength * std::pow(static_cast<double>(occlusion), settings.contrast);
  return static_cast<float>(1 - std::min(changed, 1.0));
}

image::Image blank(const bake::TextureMap& map, std::vector<std::string> channels) {
  const std::size_t count = map.size() * channels.size();
  return {map.width, map.height, std::move(channels), std::vector<float>(count)};
}

image::Image grey_image(const bake::TextureMap& map, const TextureSettings& settings) {
  image::Image image = blank(map, {"Y"});
  std::ranges::transform(map.occlusion, image.pixels.begin(),
                         [&](float value) { return visibility_of(value, settings); });
  return image;
}

// Of components from -1 to 1, or as a picture has them.
image::Image bent_image(const bake::TextureMap& map) {
  image::Image image = blank(map, {"R", "G", "B"});
  for (std::size_t i = 0; i < map.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      image.pixels[3 * i + static_cast<std::size_t>(axis)] = 0.5f * map.bent_normals[i][axis] + 0.5f;
    }
  }
  return image;
}

image::Image layered_image(const bake::TextureMap& map, const TextureSettings& settings) {
  std::vector<std::string> channels = {"visibility", "coverage"};
  if (!map.bent_normals.empty()) channels.insert(channels.end(), {"bent.X", "bent.Y", "bent.Z"});
  image::Image image = blank(map, std::move(channels));
  float* pixel = image.pixels.data();
  for (std::size_t i = 0; i < map.size(); ++i) {
    *pixel++ = visibility_of(map.occlusion[i], settings);
    *pixel++ = static_cast<float>(map.coverage[i]) / 255;
    for (int axis = 0; axis < 3 && !map.bent_normals.empty(); ++axis) *pixel++ = map.bent_normals[i][axis];
  }
  return image;
}

// What may stand in the name of a file everywhere.
std::string file_word(const std::string& name) {
  std::string word = name;
  for (char& letter : word) {
    const bool is_plain = (letter >= '0' && letter <= '9') || (letter >= 'A' && letter <= 'Z') ||
                          (letter >= 'a' && letter <= 'z') || letter == '-' || letter == '_';
    if (!is_plain) letter = '_';
  }
  return word;
}

// "ao.brass.1001.png".
class MapNames {
 public:
  MapNames(std::string output, bool has_materials) : output_(std::move(output)), has_materials_(has_materials) {}

  std::string of(const MaterialBake& material, const bake::TextureMap& map) {
    std::string words;
    if (has_materials_) words += "." + file_word(material.name);
    if (map.udim != 0) words += fmt::format(".{}", map.udim);
    std::string name = with(words);
    // Materials may have the same name, or names that differ in what files cannot have.
    for (int number = 2; !taken_.insert(name).second; ++number) name = with(fmt::format("{}-{}", words, number));
    return name;
  }

 private:
  std::string with(const std::string& words) const {
    const fs::path path(output_);
    return (path.parent_path() / (path.stem().string() + words + path.extension().string())).string();
  }

  std::string output_;
  bool has_materials_;
  std::set<std::string> taken_;
};

scene::OcclusionMap gltf_map(const std::string& output, const MaterialBake& material, const TextureSettings& settings,
                             const scene::GltfFile& model) {
  const bake::TextureMap& map = material.bake.maps.front();
  std::vector<float> occlusion = map.occlusion;
  for (float& value : occlusion) value = 1 - visibility_of(value, settings);
  const std::uint32_t number = material.material.value_or(scene::kNoMaterial);
  std::optional<scene::PackedImage> packed;
  if (number != scene::kNoMaterial) packed = model.packed_image(number, settings.uv_set);
  return {.material = number,
          .png = make_map_png(map.width, map.height, occlusion, packed, output),
          .is_packed = packed.has_value()};
}

std::string bent_name(const std::string& name) {
  const fs::path path(name);
  return (path.parent_path() / (path.stem().string() + ".bent" + path.extension().string())).string();
}

std::vector<std::string> write_images(const std::string& output, const TextureBaking& result,
                                      const TextureSettings& settings, OutputFiles& outputs) {
  std::vector<std::string> written;
  const auto write = [&](const std::string& name, const image::Image& image) {
    image::write_image(outputs.claim_image(name), image);
    written.push_back(name);
  };
  const bool is_png = ending_of(output) == ".png";
  MapNames names(output, result.materials.size() > 1);
  for (const MaterialBake& material : result.materials) {
    for (const bake::TextureMap& map : material.bake.maps) {
      const std::string name = names.of(material, map);
      write(name, is_png ? grey_image(map, settings) : layered_image(map, settings));
      if (is_png && !map.bent_normals.empty()) write(bent_name(name), bent_image(map));
    }
  }
  return written;
}

}  // namespace

void check_texture_output(const std::string& output, const TextureSettings& settings) {
  if (!is_gltf(output)) {
    if (ending_of(output) != ".png" && ending_of(output) != ".exr") {
      throw std::invalid_argument(
          fmt::format("--output: textures are written as .png, .exr, .glb or .gltf, got '{}'", output));
    }
    return image::check_image_path(output);
  }
  const std::pair<const char*, bool> unknown[] = {{"--udim", settings.udim},
                                                  {"--shared-map", settings.is_shared},
                                                  {"--thickness", settings.thickness},
                                                  {"--bent-normals", settings.bent_normals != bake::BentNormals::none}};
  for (const auto& [name, is_given] : unknown) {
    if (is_given) throw std::invalid_argument(fmt::format("{}: glTF has no place for that; write an image", name));
  }
}

std::vector<std::string> write_textures(const std::string& output, const TextureBaking& result,
                                        const TextureSettings& settings, const scene::GltfFile* model,
                                        OutputFiles& outputs) {
  if (model == nullptr) return write_images(output, result, settings, outputs);
  std::vector<scene::OcclusionMap> maps;
  maps.reserve(result.materials.size());
  for (const MaterialBake& material : result.materials) maps.push_back(gltf_map(output, material, settings, *model));
  const scene::GltfOutput written = model->with_maps(maps, settings.uv_set);
  for (const std::string& remark : written.remarks) fmt::print(stderr, "lkao: {}: {}\n", output, remark);
  write_gltf(written, output, outputs.claim(output), outputs);
  return {output};
}

}  // namespace lkao::cli
