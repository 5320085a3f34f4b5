#include "bake/texel_coverage.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lkao::bake {
namespace {

// Shares of a texel. What lies over another piece by no more than the second is neighbours that were packed without a
// gap, and rounded.
constexpr double kLeastArea = 1e-9, kLeastOverlap = 2e-3;

using Corners = std::array<glm::dvec2, 3>;

// The lines of a triangle's edges: inside, all heights are at least 0.
struct EdgeLines {
  std::array<glm::dvec2, 3> normals;
  std::array<double, 3> offsets;

  explicit EdgeLines(const Corners& corners) {
    const glm::dvec2 to_b = corners[1] - corners[0], to_c = corners[2] - corners[0];
    const double side = to_b.x * to_c.y - to_b.y * to_c.x > 0 ? 1 : -1;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec2 &from = corners[i], edge = corners[(i + 1) % 3] - from;
      normals[i] = side * glm::dvec2(-edge.y, edge.x);
      offsets[i] = glm::dot(normals[i], from);
    }
  }

  bool has_texel(const glm::ivec2& texel) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec2 farthest = glm::dvec2(texel) + glm::dvec2(normals[i].x < 0 ? 1 : 0, normals[i].y < 0 ? 1 : 0);
      if (glm::dot(normals[i], farthest) < offsets[i]) return false;
    }
    return true;
  }
};

// One triangle's pieces, row by row.
class TriangleScan {
 public:
  TriangleScan(const Corners& corners, std::uint32_t placement, const Tile& tile, std::vector<TexelPiece>& pieces)
      : lines_(corners), whole_(corners), placement_(placement), tile_(tile), pieces_(pieces) {
    const glm::dvec2 lower = glm::min(corners[0], glm::min(corners[1], corners[2]));
    const glm::dvec2 upper = glm::max(corners[0], glm::max(corners[1], corners[2]));
    const glm::ivec2 end = tile.first + tile.size;
    if (lower.x >= end.x || upper.x <= tile.first.x) return;
    const int first_row = first_texel(lower.y, tile.first.y), end_row = end_texel(upper.y, end.y);
    for (int y = first_row; y < end_row; ++y) scan_row(y);
  }

 private:
  static int first_texel(double lower, int first) {
    return static_cast<int>(std::max<double>(first, std::floor(lower)));
  }
  static int end_texel(double upper, int end) { return static_cast<int>(std::min<double>(end, std::ceil(upper))); }

  void scan_row(int y) {
    const Polygon strip = whole_.cut({0, 1}, y).cut({0, -1}, -(y + 1.0));
    if (strip.is_empty()) return;
    double lower = strip[0].x, upper = strip[0].x;
    for (std::size_t i = 1; i < strip.size(); ++i) {
      lower = std::min(lower, strip[i].x);
      upper = std::max(upper, strip[i].x);
    }
    const int end = end_texel(upper, tile_.first.x + tile_.size.x);
    for (int x = first_texel(lower, tile_.first.x); x < end; ++x) {
      const std::uint32_t texel = texel_number(glm::ivec2(x, y) - tile_.first);
      if (lines_.has_texel({x, y})) {
        pieces_.push_back({texel, placement_, 1, true});
        continue;
      }
      const double area = strip.cut({1, 0}, x).cut({-1, 0}, -(x + 1.0)).area();
      if (area > kLeastArea) pieces_.push_back({texel, placement_, area, false});
    }
  }

  EdgeLines lines_;
  Polygon whole_;
  std::uint32_t placement_;
  const Tile& tile_;
  std::vector<TexelPiece>& pieces_;
};

// Takes those of one texel in turn, unless what was taken before is in their way.
class TexelOwners {
 public:
  TexelOwners(const TextureLayout& layout, const TileCoverage& coverage) : layout_(layout), coverage_(coverage) {}

  void begin() {
    taken_.clear();
    area_ = 0;
  }
  bool take(const TexelPiece& piece) {
    if (area_ + piece.area > 1 + kLeastOverlap) return false;
    const auto is_in_the_way = [&](const TexelPiece& other) { return overlap(piece, other) > kLeastOverlap; };
    if (std::any_of(taken_.begin(), taken_.end(), is_in_the_way)) return false;
    area_ += piece.area;
    if (piece.area > kLeastOverlap) taken_.push_back(piece);
    return true;
  }

 private:
  Corners corners(const TexelPiece& piece) const { return layout_.corners(coverage_.placements[piece.placement]); }

  double overlap(const TexelPiece& a, const TexelPiece& b) const {
    if (std::min(a.area, b.area) <= kLeastOverlap) return 0;
    Polygon both = polygon_in_texel(corners(a), coverage_.tile.first + texel_place(a.texel));
    const EdgeLines lines(corners(b));
    for (std::size_t i = 0; i < 3 && !both.is_empty(); ++i) both = both.cut(lines.normals[i], lines.offsets[i]);
    return both.area();
  }

  const TextureLayout& layout_;
  const TileCoverage& coverage_;
  std::vector<TexelPiece> taken_;
  double area_ = 0;
};

void drop_overlapping(const TextureLayout& layout, TileCoverage& coverage) {
  TexelOwners owners(layout, coverage);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < coverage.pieces.size();) {
    const std::uint32_t texel = coverage.pieces[i].texel;
    bool is_overlapping = false;
    owners.begin();
    for (; i < coverage.pieces.size() && coverage.pieces[i].texel == texel; ++i) {
      if (owners.take(coverage.pieces[i])) {
        coverage.pieces[kept++] = coverage.pieces[i];
      } else {
        is_overlapping = true;
      }
    }
    coverage.overlapping_texel_count += is_overlapping;
  }
  coverage.pieces.resize(kept);
}

}  // namespace

std::uint32_t texel_number(const glm::ivec2& in_tile) {
  std::uint32_t number = 0;
  for (int bit = 0; (1 << bit) < kTileSize; ++bit) {
    number |= static_cast<std::uint32_t>((in_tile.x >> bit & 1) | (in_tile.y >> bit & 1) << 1) << (2 * bit);
  }
  return number;
}

glm::ivec2 texel_place(std::uint32_t number) {
  glm::ivec2 place(0);
  for (int bit = 0; (1 << bit) < kTileSize; ++bit) {
    place.x |= static_cast<int>(number >> (2 * bit) & 1u) << bit;
    place.y |= static_cast<int>(number >> (2 * bit + 1) & 1u) << bit;
  }
  return place;
}

Polygon polygon_in_texel(const std::array<glm::dvec2, 3>& corners, const glm::ivec2& texel) {
  return Polygon(corners).within(texel, glm::dvec2(texel) + 1.0);
}

TileCoverage cover_tile(const TextureLayout& layout, const TextureCharts& charts, const Tile& tile,
                        std::vector<Placement> placements) {
  std::sort(placements.begin(), placements.end(), [&](const Placement& a, const Placement& b) {
    const auto key = [&](const Placement& p) {
      return std::tuple(charts.firsts[p.triangle], p.triangle, p.row, p.column);
    };
    return key(a) < key(b);
  });
  TileCoverage coverage{.tile = tile, .placements = std::move(placements), .pieces = {}};
  for (std::uint32_t i = 0; i < coverage.placements.size(); ++i) {
    TriangleScan(layout.corners(coverage.placements[i]), i, tile, coverage.pieces);
  }
  std::sort(coverage.pieces.begin(), coverage.pieces.end(), [](const TexelPiece& a, const TexelPiece& b) {
    return std::tuple(a.texel, a.placement) < std::tuple(b.texel, b.placement);
  });
  drop_overlapping(layout, coverage);
  return coverage;
}

}  // namespace lkao::bake
