#include "bench/unwrapped.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "scene/disjoint_sets.h"
#include "scene/facet.h"
#include "scene/shared_edges.h"

namespace lkao::bench {
namespace {

constexpr double kGap = 4;  // texels

// The axis that a facet looks along: 0 to 2, or 3 to 5 where it looks backwards.
int direction_of(const scene::Facet& facet) {
  const glm::dvec3 normal = facet.area_vector(), size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  return normal[axis] > 0 ? axis : axis + 3;
}

// Not mirrored as seen from the front; y downwards.
glm::dvec2 seen_along(int direction, const glm::vec3& p) {
  const int axis = direction % 3, next = (axis + 1) % 3, last = (axis + 2) % 3;
  return direction < 3 ? glm::dvec2(p[next], -p[last]) : glm::dvec2(p[last], -p[next]);
}

struct Chart {
  glm::dvec2 lower{1e300}, upper{-1e300};
  glm::dvec2 place{0};  // in texels

  glm::dvec2 size(double scale) const { return scale * (upper - lower) + kGap; }
};

// Shelves of charts by falling height; true where they fit.
bool pack(std::vector<Chart>& charts, const std::vector<std::uint32_t>& by_height, double scale, double size) {
  glm::dvec2 next(0.0);
  double shelf = 0;
  for (const std::uint32_t i : by_height) {
    const glm::dvec2 needed = charts[i].size(scale);
    if (next.x + needed.x > size) next = {0, next.y + std::exchange(shelf, 0.0)};
    if (next.x + needed.x > size || next.y + needed.y > size) return false;
    charts[i].place = next + 0.5 * kGap;
    next.x += needed.x;
    shelf = std::max(shelf, needed.y);
  }
  return true;
}

double pack_largest(std::vector<Chart>& charts, double size) {
  std::vector<std::uint32_t> by_height(charts.size());
  std::iota(by_height.begin(), by_height.end(), 0u);
  double area = 0;
  for (const Chart& chart : charts) area += (chart.upper - chart.lower).x * (chart.upper - chart.lower).y;
  std::stable_sort(by_height.begin(), by_height.end(), [&charts](std::uint32_t a, std::uint32_t b) {
    return (charts[a].upper - charts[a].lower).y > (charts[b].upper - charts[b].lower).y;
  });
  double fits = 0, too_large = 2 * size / std::sqrt(area);
  for (int step = 0; step < 30; ++step) {
    const double scale = 0.5 * (fits + too_large);
    (pack(charts, by_height, scale, size) ? fits : too_large) = scale;
  }
  pack(charts, by_height, fits, size);
  return fits;
}

}  // namespace

void unwrap(scene::Mesh& mesh, int size) {
  std::vector<int> directions;
  directions.reserve(mesh.triangles.size());
  for (const glm::uvec3& triangle : mesh.triangles) directions.push_back(direction_of(scene::Facet(mesh, triangle)));
  scene::DisjointSets sets(mesh.triangles.size());
  for (const scene::SharedEdge& edge : scene::shared_edges(mesh)) {
    const std::uint32_t a = edge.sides[0].triangle, b = edge.sides[1].triangle;
    if (directions[a] == directions[b]) sets.join(a, b);
  }

  std::vector<std::uint32_t> numbers(mesh.triangles.size());
  std::vector<Chart> charts;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t first = sets.find(t);
    if (first == t) {
      numbers[t] = static_cast<std::uint32_t>(charts.size());
      charts.emplace_back();
    }
    numbers[t] = numbers[first];
    for (int i = 0; i < 3; ++i) {
      const glm::dvec2 p = seen_along(directions[t], mesh.positions[mesh.triangles[t][i]]);
      charts[numbers[t]].lower = glm::min(charts[numbers[t]].lower, p);
      charts[numbers[t]].upper = glm::max(charts[numbers[t]].upper, p);
    }
  }

  const double scale = pack_largest(charts, size);
  mesh.uvs.clear();
  mesh.uv_corners.clear();
  mesh.uvs.reserve(3 * mesh.triangles.size());
  mesh.uv_corners.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Chart& chart = charts[numbers[t]];
    for (int i = 0; i < 3; ++i) {
      const glm::dvec2 p = seen_along(directions[t], mesh.positions[mesh.triangles[t][i]]);
      mesh.uvs.emplace_back((chart.place + scale * (p - chart.lower)) / static_cast<double>(size));
    }
    const std::uint32_t first = 3 * t;
    mesh.uv_corners.emplace_back(first, first + 1, first + 2);
  }
}

}  // namespace lkao::bench
