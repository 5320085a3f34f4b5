// Baking into textures, on the command line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bake/texture_options.h"
#include "cli/parse.h"
#include "method/radius.h"
#include "scene/contents.h"

namespace CLI {
class App;
}

namespace lkao::cli {

// What was asked for, of all maps.
struct TextureSettings {
  std::optional<Size> size;  // texels of a map; none: baking is into the mesh
  int uv_set = 0;
  std::string material;                    // the only one to bake, by its name; empty: all
  bool is_shared = false;                  // one map for all materials
  std::optional<scene::TextureWrap> wrap;  // instead of what the file says
  bool udim = false;
  int grid = 1;  // samples along each side of a texel
  std::optional<int> margin;
  bake::BentNormals bent_normals = bake::BentNormals::none;
  bool thickness = false;
  // A file whose occlusion the map shows, and how far from the scene's surface its own may be.
  std::string detailed;
  method::Radius extrusion{2, true};
  bool keeps_seams = false;
  // What is written is strength x occlusion ^ contrast.
  double strength = 1, contrast = 1;

  // Of one material's map, or of that of all.
  bake::TextureOptions options(std::optional<std::uint32_t> chosen_material, const scene::TextureWraps& wraps,
                               const bake::Cage* cage) const;
};

// All of them need --texture.
void add_texture_options(CLI::App& app, TextureSettings& settings);

}  // namespace lkao::cli
