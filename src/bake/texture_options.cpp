#include "bake/texture_options.h"

#include <algorithm>

#include "lut/require.h"

namespace lkao::bake {

void check(const TextureOptions& options) {
  const auto require_between = [](const char* option, const char* range, int least, int value, int most) {
    lut::require(value >= least && value <= most, option, range, value);
  };
  require_between("width", "1 to 32768", 1, options.width, kMaxTextureSize);
  require_between("height", "1 to 32768", 1, options.height, kMaxTextureSize);
  require_between("grid", "1 to 16", 1, options.grid, kMaxTextureGrid);
  require_between("edge_grid", "1 to 16", 1, options.edge_grid, kMaxTextureGrid);
  require_between("margin", "0 to 32768", 0, options.margin.value_or(0), kMaxTextureSize);
}

int usual_margin(const TextureOptions& options) { return std::max(2, std::max(options.width, options.height) / 64); }

}  // namespace lkao::bake
