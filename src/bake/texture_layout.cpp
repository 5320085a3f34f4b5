#include "bake/texture_layout.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scene/facet.h"

namespace lkao::bake {
namespace {

// Texture coordinates beyond this have no fraction left that would name a texel.
constexpr double kFarthestUv = 1 << 20;
// Of a triangle; what repeats more often lies over itself many times.
constexpr std::size_t kMostSquares = 64;
// In texture coordinates: what reaches so little into a square, by rounding, is not shown by it.
constexpr double kRounding = 1e-6;
constexpr int kUdimColumns = 10, kUdimRows = 900;

bool is_odd(int i) { return i % 2 != 0; }

}  // namespace

TextureLayout::TextureLayout(const scene::CornerNormals& normals, const TextureOptions& options)
    : normals_(normals), options_(options) {
  check(options);
  if (mesh().uv_corners.empty()) {
    throw std::invalid_argument("bake: the mesh has no texture coordinates, and none are made up");
  }
  squares_.resize(mesh().triangles.size());
  is_mirrored_.resize(mesh().triangles.size());
  for (std::uint32_t t = 0; t < mesh().triangles.size(); ++t) {
    if (is_chosen(t)) place(t);
  }
  if (report_.triangle_count == report_.bare_triangle_count) {
    throw std::invalid_argument("bake: no triangle to bake has texture coordinates, and none are made up");
  }
  if (options_.udim) find_udims();
}

bool TextureLayout::is_chosen(std::uint32_t triangle) const {
  if (!options_.material) return true;
  return (mesh().materials.empty() ? scene::kNoMaterial : mesh().materials[triangle]) == *options_.material;
}

glm::dvec2 TextureLayout::uv(std::uint32_t triangle, std::uint32_t corner) const {
  return mesh().uvs[mesh().uv_corners[triangle][static_cast<int>(corner)]];
}

bool TextureLayout::has_same_uvs(const scene::SharedEdge& edge) const {
  const auto& [a, b] = edge.sides;
  return uv(a.triangle, a.from) == uv(b.triangle, b.to()) && uv(a.triangle, a.to()) == uv(b.triangle, b.from);
}

bool TextureLayout::has_uvs(std::uint32_t triangle) const {
  for (std::uint32_t i = 0; i < 3; ++i) {
    if (mesh().uv_corners[triangle][static_cast<int>(i)] == scene::kNoUv) return false;
    const glm::dvec2 p = uv(triangle, i);
    if (!(std::abs(p.x) <= kFarthestUv && std::abs(p.y) <= kFarthestUv)) return false;
  }
  return true;
}

TextureLayout::Squares TextureLayout::squares_of(std::uint32_t triangle) const {
  const glm::dvec2 a = uv(triangle, 0), b = uv(triangle, 1), c = uv(triangle, 2);
  const glm::dvec2 lower = glm::floor(glm::min(a, glm::min(b, c)) + kRounding);
  const glm::dvec2 upper = glm::max(lower, glm::ceil(glm::max(a, glm::max(b, c)) - kRounding) - 1.0);
  return {.first_column = static_cast<int>(lower.x),
          .last_column = static_cast<int>(upper.x),
          .first_row = static_cast<int>(lower.y),
          .last_row = static_cast<int>(upper.y)};
}

void TextureLayout::place(std::uint32_t triangle) {
  ++report_.triangle_count;
  if (!has_uvs(triangle)) {
    ++report_.bare_triangle_count;
    return;
  }
  const glm::dvec2 a = uv(triangle, 0), to_b = uv(triangle, 1) - a, to_c = uv(triangle, 2) - a;
  const double turn = to_b.x * to_c.y - to_b.y * to_c.x;  // v runs downwards: positive where it is clockwise
  const scene::Facet facet(mesh(), mesh().triangles[triangle]);
  if (turn == 0 || !facet.is_usable()) {
    ++report_.flat_triangle_count;
    return;
  }
  const bool is_turned = glm::dot(facet.area_vector(), normals_.of(triangle).facet) < 0;
  is_mirrored_[triangle] = (turn > 0) != is_turned;
  report_.mirrored_triangle_count += is_mirrored_[triangle];

  const Squares squares = squares_of(triangle);
  squares_[triangle] = squares;
  report_.wide_triangle_count += squares.count() > kMostSquares;
  // One triangle's squares are a rectangle: if its ends are inside, so is the rest.
  const auto is_outside = [&](int column, int row) {
    const bool in_u =
        options_.udim ? column >= 0 && column < kUdimColumns : options_.wrap_u != Wrap::clamp || column == 0;
    const bool in_v = options_.udim ? row <= 0 && row > -kUdimRows : options_.wrap_v != Wrap::clamp || row == 0;
    return !in_u || !in_v;
  };
  report_.outside_triangle_count +=
      is_outside(squares.first_column, squares.first_row) || is_outside(squares.last_column, squares.last_row);
}

void TextureLayout::find_udims() {
  std::set<int> numbers;
  for (const Squares& squares : squares_) {
    if (squares.count() == 0) continue;
    for (int row = std::max(squares.first_row, 1 - kUdimRows); row <= std::min(squares.last_row, 0); ++row) {
      for (int column = std::max(squares.first_column, 0); column <= std::min(squares.last_column, kUdimColumns - 1);
           ++column) {
        numbers.insert(1001 + column - 10 * row);
      }
    }
  }
  if (numbers.empty()) throw std::invalid_argument("bake: no triangle lies in a UDIM tile");
  udims_.assign(numbers.begin(), numbers.end());
}

std::optional<std::size_t> TextureLayout::map_of(int column, int row) const {
  if (options_.udim) {
    if (column < 0 || column >= kUdimColumns || row > 0 || row <= -kUdimRows) return std::nullopt;
    const auto found = std::lower_bound(udims_.begin(), udims_.end(), 1001 + column - 10 * row);
    return static_cast<std::size_t>(found - udims_.begin());
  }
  if (options_.wrap_u == Wrap::clamp && column != 0) return std::nullopt;
  if (options_.wrap_v == Wrap::clamp && row != 0) return std::nullopt;
  return 0;
}

glm::dvec2 TextureLayout::in_texels(const glm::dvec2& uv, int column, int row) const {
  glm::dvec2 p = uv - glm::dvec2(column, row);
  if (!options_.udim && options_.wrap_u == Wrap::mirror && is_odd(column)) p.x = 1 - p.x;
  if (!options_.udim && options_.wrap_v == Wrap::mirror && is_odd(row)) p.y = 1 - p.y;
  return p * glm::dvec2(options_.width, options_.height);
}

std::array<glm::dvec2, 3> TextureLayout::corners(const Placement& placement) const {
  const auto& [triangle, column, row] = placement;
  return {in_texels(uv(triangle, 0), column, row), in_texels(uv(triangle, 1), column, row),
          in_texels(uv(triangle, 2), column, row)};
}

std::vector<Placement> TextureLayout::placements(std::size_t map, int first_row, int end_row) const {
  std::vector<Placement> result;
  for (std::uint32_t t = 0; t < squares_.size(); ++t) {
    const Squares& squares = squares_[t];
    std::size_t count = 0;
    for (int row = squares.first_row; row <= squares.last_row && count < kMostSquares; ++row) {
      for (int column = squares.first_column; column <= squares.last_column && count < kMostSquares;
           ++column, ++count) {
        if (map_of(column, row) != map) continue;
        const Placement placement{t, column, row};
        const std::array<glm::dvec2, 3> p = corners(placement);
        if (std::max(p[0].y, std::max(p[1].y, p[2].y)) <= first_row) continue;
        if (std::min(p[0].y, std::min(p[1].y, p[2].y)) >= end_row) continue;
        result.push_back(placement);
      }
    }
  }
  return result;
}

}  // namespace lkao::bake
