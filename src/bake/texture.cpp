#include "bake/texture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include "bake/edge_clearance.h"
#include "bake/padding.h"
#include "bake/tangent_frames.h"
#include "bake/texel_coverage.h"
#include "bake/texel_receivers.h"
#include "bake/texture_charts.h"
#include "bake/texture_layout.h"
#include "bake/texture_seams.h"
#include "lut/progress_sum.h"
#include "lut/require.h"

namespace lkao::bake {
namespace {

constexpr std::size_t kTilesAtOnce = 16;
constexpr std::size_t kReceiversAtOnce = std::size_t{1} << 16;

int tiles_along(int size) { return (size + kTileSize - 1) / kTileSize; }

// The mean of a texel, while its receivers come.
struct TexelMean {
  double occlusion = 0, weight = 0, area = 0;
  glm::dvec3 bent_normal{0};

  void add(double share, float value, const glm::vec3* direction) {
    area += share;
    if (std::isnan(value)) return;
    weight += share;
    occlusion += share * static_cast<double>(value);
    if (direction != nullptr) bent_normal += share * glm::dvec3(*direction);
  }
};

class TexelBaker {
 public:
  TexelBaker(const TextureLayout& layout, const Bounds& occluders, const Ask& ask, const TexturePart& part,
             const Progress& progress)
      : layout_(layout),
        charts_(find_charts(layout)),
        clearance_(edge_clearance(occluders)),
        ask_(ask),
        part_(part),
        progress_(progress) {
    if (layout.options().bent_normals == BentNormals::tangent) frames_.emplace(layout);
    bake_.report = layout.report();
    bake_.maps.reserve(layout.udims().size());
    for (const int udim : layout.udims()) bake_.maps.push_back(empty_map(udim));
    for (const TextureMap& map : bake_.maps) bake_.report.texel_count += map.size();
  }

  TextureBake run() {
    const int row_count = tiles_along(layout_.options().height);
    for (int row = 0; row < row_count; ++row) {
      for (const Tile& tile : tiles_of(0, row)) texel_count_ += bake_.maps.size() * size_of(tile);
    }
    tell();
    for (std::size_t map = 0; map < bake_.maps.size(); ++map) {
      for (int row = 0; row < row_count; ++row) run_row(map, row);
    }
    return std::move(bake_);
  }

 private:
  struct PreparedTile {
    TileCoverage coverage;
    TexelReceivers receivers;
  };

  bool has_bent_normals() const { return layout_.options().bent_normals != BentNormals::none; }

  TextureMap empty_map(int udim) const {
    constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
    TextureMap map{.udim = udim,
                   .width = layout_.options().width,
                   .height = layout_.options().height,
                   .occlusion = {},
                   .bent_normals = {},
                   .coverage = {}};
    map.occlusion.assign(map.size(), kNothing);
    map.coverage.assign(map.size(), 0);
    if (has_bent_normals()) map.bent_normals.assign(map.size(), glm::vec3(kNothing));
    return map;
  }

  std::size_t tile_number(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(tiles_along(layout_.options().width)) +
           static_cast<std::size_t>(column);
  }

  // The first index of a tile's receivers: the same whatever else is baked.
  std::uint64_t first_index(const Tile& tile) const {
    const auto udim = static_cast<std::uint64_t>(bake_.maps[tile.map].udim);
    return (udim << 16 | tile_number(tile.first.y / kTileSize, tile.first.x / kTileSize)) << 32;
  }

  static std::size_t size_of(const Tile& tile) {
    return static_cast<std::size_t>(tile.size.x) * static_cast<std::size_t>(tile.size.y);
  }

  // Those of the part.
  std::vector<Tile> tiles_of(std::size_t map, int row) const {
    const glm::ivec2 size(layout_.options().width, layout_.options().height);
    std::vector<Tile> tiles;
    tiles.reserve(static_cast<std::size_t>(tiles_along(size.x)));
    for (int column = 0; column < tiles_along(size.x); ++column) {
      if (tile_number(row, column) % part_.count != part_.index) continue;
      const glm::ivec2 first(column * kTileSize, row * kTileSize);
      tiles.push_back({map, first, glm::min(size - first, glm::ivec2(kTileSize))});
    }
    return tiles;
  }

  void run_row(std::size_t map, int row) {
    const std::vector<Tile> tiles = tiles_of(map, row);
    if (tiles.empty()) return;
    const std::vector<Placement> placements = layout_.placements(map, row * kTileSize, (row + 1) * kTileSize);
    for (std::size_t i = 0; i < tiles.size(); i += kTilesAtOnce) {
      run_tiles(std::span(tiles).subspan(i, std::min(kTilesAtOnce, tiles.size() - i)), placements);
    }
  }

  void run_tiles(std::span<const Tile> tiles, const std::vector<Placement>& placements) {
    std::vector<PreparedTile> prepared(tiles.size());
    tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
      prepared[i].coverage = cover_tile(layout_, charts_, tiles[i], placements_in(tiles[i], placements));
      prepared[i].receivers = make_receivers(layout_, prepared[i].coverage, clearance_, frames_ ? &*frames_ : nullptr);
    });
    for (PreparedTile& tile : prepared) {
      answer(tile);
      tile = {};
    }
  }

  std::vector<Placement> placements_in(const Tile& tile, const std::vector<Placement>& of_row) const {
    std::vector<Placement> result;
    std::copy_if(of_row.begin(), of_row.end(), std::back_inserter(result), [&](const Placement& placement) {
      const std::array<glm::dvec2, 3> p = layout_.corners(placement);
      return std::max(p[0].x, std::max(p[1].x, p[2].x)) > tile.first.x &&
             std::min(p[0].x, std::min(p[1].x, p[2].x)) < tile.first.x + tile.size.x;
    });
    return result;
  }

  void answer(const PreparedTile& tile) {
    const std::span<const Receiver> receivers(tile.receivers.receivers);
    std::vector<float> occlusion(receivers.size());
    std::vector<glm::vec3> bent_normals(has_bent_normals() ? receivers.size() : 0);
    const std::uint64_t index = first_index(tile.coverage.tile);
    for (std::size_t first = 0; first < receivers.size(); first += kReceiversAtOnce) {
      const std::size_t count = std::min(kReceiversAtOnce, receivers.size() - first);
      QueryOutputs outputs{.occlusion = std::span(occlusion).subspan(first, count)};
      if (has_bent_normals()) outputs.bent_normals = std::span(bent_normals).subspan(first, count);
      ask_(receivers.subspan(first, count), outputs, index + first);
    }
    for (std::size_t i = 0; i < tile.receivers.frames.size(); ++i) {
      bent_normals[i] = glm::transpose(tile.receivers.frames[i]) * bent_normals[i];
    }
    store(tile, occlusion, bent_normals);
    bake_.report.overlapping_texel_count += tile.coverage.overlapping_texel_count;
    bake_.report.receiver_count += receivers.size();
    bake_.report.missed_receiver_count += tile.receivers.missed_count;
    done_ += size_of(tile.coverage.tile);
    tell();
  }

  void tell() const {
    if (progress_ && !progress_(done_, texel_count_)) throw Cancelled();
  }

  // Means of the receivers of each texel in turn.
  void store(const PreparedTile& tile, std::span<const float> occlusion, std::span<const glm::vec3> bent_normals) {
    const TexelReceivers& made = tile.receivers;
    for (std::size_t i = 0; i < made.texels.size();) {
      const std::uint32_t texel = made.texels[i];
      TexelMean mean;
      for (; i < made.texels.size() && made.texels[i] == texel; ++i) {
        mean.add(static_cast<double>(made.weights[i]), occlusion[i], bent_normals.empty() ? nullptr : &bent_normals[i]);
      }
      put(tile.coverage.tile, texel, mean);
    }
  }

  void put(const Tile& tile, std::uint32_t number, const TexelMean& mean) {
    TextureMap& map = bake_.maps[tile.map];
    const glm::ivec2 place = tile.first + texel_place(number);
    const std::size_t texel = map.texel(place.x, place.y);
    ++bake_.report.covered_texel_count;
    map.coverage[texel] = static_cast<std::uint8_t>(std::clamp(std::ceil(255 * mean.area - 1e-3), 1.0, 255.0));
    if (!(mean.weight > 0)) {
      ++bake_.report.empty_texel_count;
      return;
    }
    map.occlusion[texel] = static_cast<float>(mean.occlusion / mean.weight);
    if (!map.bent_normals.empty()) map.bent_normals[texel] = unit(mean.bent_normal);
  }

  // Directions that cancel have no mean: straight up will do.
  static glm::vec3 unit(const glm::dvec3& sum) {
    const double length = glm::length(sum);
    return length > 1e-6 ? glm::vec3(sum / length) : glm::vec3(0, 0, 1);
  }

  const TextureLayout& layout_;
  TextureCharts charts_;
  double clearance_;
  const Ask& ask_;
  TexturePart part_;
  const Progress& progress_;
  std::optional<TangentFrames> frames_;
  TextureBake bake_;
  std::size_t texel_count_ = 0, done_ = 0;  // of the part
};

bool has_no_texel(const TextureMap& map) {
  return std::all_of(map.coverage.begin(), map.coverage.end(), [](std::uint8_t coverage) { return coverage == 0; });
}

}  // namespace

TextureBake bake_texels(const scene::CornerNormals& normals, const Bounds& occluders, const TextureOptions& options,
                        const Ask& ask, const TexturePart& part, const Progress& progress) {
  lut::require(part.count > 0, "part.count", "at least 1", static_cast<double>(part.count));
  lut::require(part.index < part.count, "part.index", "less than part.count", static_cast<double>(part.index));
  const TextureLayout layout(normals, options);
  return TexelBaker(layout, occluders, ask, part, progress).run();
}

void finish_texture(const scene::CornerNormals& normals, const TextureOptions& options, TextureBake& bake,
                    const Progress& progress) {
  const TextureLayout layout(normals, options);
  const std::size_t map_count = bake.maps.size();
  lut::ProgressSum steps(progress, options.level_seams ? 3 * map_count + 1 : 2 * map_count);
  // What a bilinear filter reads on the border of a chart.
  constexpr int kFilterReach = 2;
  int margin = options.margin.value_or(usual_margin(options));
  if (options.level_seams) {
    for (TextureMap& map : bake.maps) {
      grow(map, kFilterReach, options);
      steps.add(1);
    }
    margin = std::max(0, margin - kFilterReach);
    const TextureCharts charts = find_charts(layout);
    const SeamDifferences differences = level_seams(layout, charts, bake.maps);
    bake.report.seam_count = charts.seams.size();
    bake.report.worst_seam_before = differences.before;
    bake.report.worst_seam_after = differences.after;
    steps.add(1);
  }
  for (TextureMap& map : bake.maps) {
    grow(map, margin, options);
    steps.add(1);
    flood(map);
    steps.add(1);
  }
  // A square that only the box around a triangle reaches.
  if (options.udim) std::erase_if(bake.maps, has_no_texel);
}

TextureBake bake_texture(const scene::CornerNormals& normals, const Bounds& occluders, const TextureOptions& options,
                         const Ask& ask, const Progress& progress) {
  TextureBake bake = bake_texels(normals, occluders, options, ask, {}, progress);
  const std::size_t texel_count = bake.report.texel_count;
  Progress at_the_end;
  if (progress) at_the_end = [&](std::size_t, std::size_t) { return progress(texel_count, texel_count); };
  finish_texture(normals, options, bake, at_the_end);
  return bake;
}

}  // namespace lkao::bake
