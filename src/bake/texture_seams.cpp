#include "bake/texture_seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "bake/conjugate_gradients.h"
#include "bake/texel_neighbours.h"

namespace lkao::bake {
namespace {

// Of keeping a whole texel as it is, against both sides being equal at a point.
constexpr double kKeep = 1e-4;
// Texels that triangles cover less than this are kept like these: they are there for the filter alone.
constexpr double kLeastCoverage = 0.1;

// A texel that a filter reads on a seam.
struct SeamTexel {
  std::size_t map, texel;
};

struct Tap {
  std::uint32_t unknown;
  double weight;
};

// What the filter shows on one side of a seam, less what it shows on the other.
using Difference = std::array<Tap, 8>;

double value_of(const Difference& difference, std::span<const double> x) {
  double sum = 0;
  for (const Tap& tap : difference) sum += tap.weight * x[tap.unknown];
  return sum;
}

class SeamPoints {
 public:
  SeamPoints(const TextureLayout& layout, const TextureCharts& charts, const std::vector<TextureMap>& maps)
      : layout_(layout), maps_(maps), neighbours_(layout.options().width, layout.options().height, layout.options()) {
    for (const scene::SharedEdge& edge : charts.seams) add_edge(edge);
  }

  const std::vector<SeamTexel>& texels() const { return texels_; }
  const std::vector<Difference>& differences() const { return differences_; }

 private:
  // One side of an edge in the texels of one map. Where the edge runs along the border of two squares, the square is
  // the one that the triangle is in.
  struct Side {
    const TextureLayout& layout;
    glm::dvec2 from, to, inside;

    Side(const TextureLayout& of_layout, const scene::EdgeSide& side, bool is_reversed)
        : layout(of_layout), from(layout.uv(side.triangle, side.from)), to(layout.uv(side.triangle, side.to())) {
      inside = (from + to + layout.uv(side.triangle, side.opposite())) / 3.0;
      if (is_reversed) std::swap(from, to);
    }

    glm::dvec2 size() const { return glm::dvec2(layout.options().width, layout.options().height); }
    double length() const { return glm::distance(from * size(), to * size()); }
    std::optional<std::pair<std::size_t, glm::dvec2>> at(double share) const {
      const glm::dvec2 uv = glm::mix(from, to, share);
      const glm::ivec2 square(glm::floor(glm::mix(uv, inside, 1e-4)));
      const std::optional<std::size_t> map = layout.map_of(square.x, square.y);
      if (!map) return std::nullopt;
      return std::pair(*map, layout.in_texels(uv, square.x, square.y));
    }
  };

  void add_edge(const scene::SharedEdge& edge) {
    const Side a(layout_, edge.sides[0], false), b(layout_, edge.sides[1], true);
    // A longer edge goes round the map several times.
    const double longest = 2.0 * (layout_.options().width + layout_.options().height);
    const int steps = 1 + static_cast<int>(std::ceil(4 * std::min(longest, std::max(a.length(), b.length()))));
    for (int i = 0; i <= steps; ++i) {
      const double share = static_cast<double>(i) / steps;
      const auto at_a = a.at(share), at_b = b.at(share);
      if (!at_a || !at_b) continue;
      Difference difference;
      if (!add_taps(at_a->first, at_a->second, 1, difference.data())) continue;
      if (!add_taps(at_b->first, at_b->second, -1, difference.data() + 4)) continue;
      differences_.push_back(difference);
    }
  }

  // Those of a bilinear filter; false where it reads an unknown texel.
  bool add_taps(std::size_t map, const glm::dvec2& point, double sign, Tap* taps) {
    const glm::dvec2 corner = glm::floor(point - 0.5), share = point - 0.5 - corner;
    for (int i = 0; i < 4; ++i) {
      const glm::ivec2 step(i & 1, i >> 1);
      const glm::ivec2 place = neighbours_.nearest(glm::ivec2(corner) + step);
      const double weight = (step.x != 0 ? share.x : 1 - share.x) * (step.y != 0 ? share.y : 1 - share.y);
      const std::size_t texel = maps_[map].texel(place.x, place.y);
      if (std::isnan(maps_[map].occlusion[texel])) return false;
      taps[i] = {unknown_of(map, texel), sign * weight};
    }
    return true;
  }

  std::uint32_t unknown_of(std::size_t map, std::size_t texel) {
    const auto [found, is_new] = numbers_.try_emplace(map * maps_[map].size() + texel, texels_.size());
    if (is_new) texels_.push_back({map, texel});
    return static_cast<std::uint32_t>(found->second);
  }

  const TextureLayout& layout_;
  const std::vector<TextureMap>& maps_;
  TexelNeighbours neighbours_;
  std::unordered_map<std::size_t, std::size_t> numbers_;
  std::vector<SeamTexel> texels_;
  std::vector<Difference> differences_;
};

double worst(const std::vector<Difference>& differences, std::span<const double> values) {
  double largest = 0;
  for (const Difference& difference : differences) {
    largest = std::max(largest, std::abs(value_of(difference, values)));
  }
  return largest;
}

// Moves `values` by the least squares of (differences)^2 + keep x (change)^2.
void level(const SeamPoints& points, const std::vector<double>& keep, std::vector<double>& values) {
  const std::size_t count = values.size();
  std::vector<double> diagonal = keep, right_side(count), change(count);
  for (const Difference& difference : points.differences()) {
    const double now = value_of(difference, values);
    for (const Tap& tap : difference) {
      diagonal[tap.unknown] += tap.weight * tap.weight;
      right_side[tap.unknown] -= tap.weight * now;
    }
  }
  const auto multiply = [&](std::span<const double> x, std::span<double> y) {
    for (std::size_t i = 0; i < count; ++i) y[i] = keep[i] * x[i];
    for (const Difference& difference : points.differences()) {
      const double value = value_of(difference, x);
      for (const Tap& tap : difference) y[tap.unknown] += tap.weight * value;
    }
  };
  solve(multiply, diagonal, right_side, change, {.tolerance = 1e-4, .most_iterations = 1000});
  for (std::size_t i = 0; i < count; ++i) values[i] += change[i];
}

std::vector<double> occlusion_of(const SeamPoints& points, const std::vector<TextureMap>& maps) {
  std::vector<double> values;
  values.reserve(points.texels().size());
  for (const auto& [map, texel] : points.texels()) values.push_back(static_cast<double>(maps[map].occlusion[texel]));
  return values;
}

void level_bent_normals(const SeamPoints& points, const std::vector<double>& keep, std::vector<TextureMap>& maps) {
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    values.reserve(points.texels().size());
    for (const auto& [map, texel] : points.texels()) {
      values.push_back(static_cast<double>(maps[map].bent_normals[texel][axis]));
    }
    level(points, keep, values);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto& [map, texel] = points.texels()[i];
      maps[map].bent_normals[texel][axis] = static_cast<float>(values[i]);
    }
  }
  for (const auto& [map, texel] : points.texels()) {
    glm::vec3& normal = maps[map].bent_normals[texel];
    normal = glm::dot(normal, normal) > 0 ? glm::normalize(normal) : glm::vec3(0, 0, 1);
  }
}

}  // namespace

double worst_seam_difference(const TextureLayout& layout, const TextureCharts& charts,
                             const std::vector<TextureMap>& maps) {
  const SeamPoints points(layout, charts, maps);
  return worst(points.differences(), occlusion_of(points, maps));
}

SeamDifferences level_seams(const TextureLayout& layout, const TextureCharts& charts, std::vector<TextureMap>& maps) {
  const SeamPoints points(layout, charts, maps);
  std::vector<double> keep, values = occlusion_of(points, maps);
  keep.reserve(values.size());
  for (const auto& [map, texel] : points.texels()) {
    keep.push_back(kKeep * std::max(kLeastCoverage, maps[map].coverage[texel] / 255.0));
  }
  SeamDifferences differences{.before = worst(points.differences(), values)};
  level(points, keep, values);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& [map, texel] = points.texels()[i];
    values[i] = std::clamp(values[i], 0.0, 1.0);
    maps[map].occlusion[texel] = static_cast<float>(values[i]);
  }
  differences.after = worst(points.differences(), values);
  if (layout.options().bent_normals == BentNormals::object && !maps.empty()) level_bent_normals(points, keep, maps);
  return differences;
}

}  // namespace lkao::bake
