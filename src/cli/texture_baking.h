// What a bake into textures computes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bake/texture.h"
#include "cli/baking.h"
#include "cli/progress_bar.h"
#include "cli/texture_options.h"

namespace lkao::cli {

// The maps of one material, or of all together.
struct MaterialBake {
  std::optional<std::uint32_t> material;  // a number in Contents::materials, or kNoMaterial; none: of all
  std::string name;                       // of the material
  bake::TextureBake bake;
};

struct TextureBaking {
  Baking baking;  // its batch has no values
  std::vector<MaterialBake> materials;

  // Over covered texels, by area; NaN where there is none.
  double occlusion_mean() const;
};

// Throws std::exception with one line for whatever is wrong.
TextureBaking compute_texture_baking(const BakingOptions& options, const TextureSettings& settings,
                                     ProgressBar& progress);

}  // namespace lkao::cli
