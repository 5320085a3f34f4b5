#include "cli/texture_baking.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "bake/cage.h"
#include "cli/baking_steps.h"

namespace lkao::cli {
namespace {

// Materials of triangles that have texture coordinates, in order.
std::vector<std::uint32_t> materials_with_uvs(const scene::Mesh& mesh) {
  std::vector<std::uint32_t> materials;
  for (std::size_t t = 0; t < mesh.uv_corners.size(); ++t) {
    const std::uint32_t material = mesh.materials.empty() ? scene::kNoMaterial : mesh.materials[t];
    if (mesh.uv_corners[t] == glm::uvec3(scene::kNoUv)) continue;
    const auto place = std::lower_bound(materials.begin(), materials.end(), material);
    if (place == materials.end() || *place != material) materials.insert(place, material);
  }
  return materials;
}

std::string name_of(std::uint32_t material, const scene::Contents& contents) {
  if (material == scene::kNoMaterial) return "no material";
  const std::string& name = contents.materials.at(material);
  return name.empty() ? fmt::format("material {}", material) : name;
}

// What to bake, still without maps.
std::vector<MaterialBake> choose_materials(const SceneInput& scene, const TextureSettings& settings) {
  const std::vector<std::uint32_t> materials = materials_with_uvs(scene.mesh);
  if (materials.empty()) {
    throw std::runtime_error(fmt::format(
        "{}: no triangle has texture coordinates ({}); unwrap it in a modelling program", scene.name, settings.uv_set));
  }
  if (settings.is_shared || scene.mesh.materials.empty()) return {{.material = {}, .name = "the mesh", .bake = {}}};
  std::vector<MaterialBake> chosen;
  std::string known;
  for (const std::uint32_t material : materials) {
    const std::string name = name_of(material, scene.contents);
    known += (known.empty() ? "" : ", ") + name;
    if (!settings.material.empty() && name != settings.material) continue;
    chosen.push_back({.material = material, .name = name, .bake = {}});
  }
  if (chosen.empty()) {
    throw std::invalid_argument(
        fmt::format("--material: no '{}' in {} (known: {})", settings.material, scene.name, known));
  }
  return chosen;
}

scene::TextureWraps wraps_of(const MaterialBake& chosen, const scene::Contents& contents) {
  const bool is_known = chosen.material && *chosen.material < contents.wraps.size();
  return is_known ? contents.wraps[*chosen.material] : scene::TextureWraps{};
}

// Around the scene; what blocks is from now on the detailed mesh alone.
class CageAround {
 public:
  CageAround(const TextureSettings& settings, SceneInput& scene)
      : mesh_(scene.with_blockers.emplace(load_beside(settings.detailed, scene))),
        normals_(mesh_, scene::usual_normals(mesh_)),
        cage_(normals_, scene.mesh, settings.extrusion.in(scene::bounds_of(scene.mesh))) {}

  const bake::Cage& cage() const { return cage_; }

 private:
  const scene::Mesh& mesh_;
  scene::CornerNormals normals_;
  bake::Cage cage_;
};

}  // namespace

TextureBaking compute_texture_baking(const BakingOptions& options, const TextureSettings& settings,
                                     ProgressBar& progress) {
  TextureBaking result;
  Baking& baking = result.baking;
  load_for_baking(options, baking, progress);
  result.materials = choose_materials(baking.scene, settings);
  std::optional<CageAround> around;
  if (!settings.detailed.empty()) around.emplace(settings, baking.scene);
  const Asker asker(options, baking, progress);
  const bake::Ask ask = [&](std::span<const Receiver> receivers, const QueryOutputs& outputs, std::uint64_t first) {
    asker.answer(receivers, outputs, first);
  };
  const scene::CornerNormals normals(baking.scene.mesh, baking.normals);
  const Bounds occluders = scene::bounds_of(baking.scene.occluders());
  for (MaterialBake& chosen : result.materials) {
    const bake::TextureOptions texture =
        settings.options(chosen.material, wraps_of(chosen, baking.scene.contents), around ? &around->cage() : nullptr);
    chosen.bake = bake::bake_texels(normals, occluders, texture, ask, {}, progress.watch(chosen.name));
    if (options.parts.part) continue;
    bake::finish_texture(normals, texture, chosen.bake, progress.watch("finishing the map of " + chosen.name));
  }
  progress.clear();
  return result;
}

double TextureBaking::occlusion_mean() const {
  double sum = 0, area = 0;
  for (const MaterialBake& of_material : materials) {
    for (const bake::TextureMap& map : of_material.bake.maps) {
      for (std::size_t i = 0; i < map.size(); ++i) {
        if (map.coverage[i] == 0 || std::isnan(map.occlusion[i])) continue;
        sum += map.coverage[i] * static_cast<double>(map.occlusion[i]);
        area += map.coverage[i];
      }
    }
  }
  return area > 0 ? sum / area : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace lkao::cli
