#include "bake/least_squares.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "bake/conjugate_gradients.h"
#include "scene/facet.h"
#include "scene/shared_edges.h"

namespace lkao::bake {
namespace {

using scene::EdgeSide, scene::Facet, scene::SharedEdge;

// weight x (coefficients . values of the places)^2: how much the slope changes over an edge, unfolded.
struct EdgeBend {
  std::array<std::uint32_t, 4> places;
  std::array<double, 4> coefficients;
  double weight;

  void multiply_add(std::span<const double> x, std::span<double> y) const {
    double bend = 0;
    for (std::size_t i = 0; i < 4; ++i) bend += coefficients[i] * x[places[i]];
    for (std::size_t i = 0; i < 4; ++i) y[places[i]] += weight * bend * coefficients[i];
  }
};

// A triangle's share of the matrix of the samples: the paper's, with the integral taken at the samples,
// so that a signal that is linear on the triangle is met exactly.
struct MassBlock {
  std::array<std::uint32_t, 3> places;
  std::array<double, 6> entries = {};  // 00 11 22 01 12 20

  void add(double weight, const glm::dvec3& w) {
    const double products[6] = {w.x * w.x, w.y * w.y, w.z * w.z, w.x * w.y, w.y * w.z, w.z * w.x};
    for (std::size_t i = 0; i < 6; ++i) entries[i] += weight * products[i];
  }
  void multiply_add(std::span<const double> x, std::span<double> y) const {
    const double a = x[places[0]], b = x[places[1]], c = x[places[2]];
    y[places[0]] += entries[0] * a + entries[3] * b + entries[5] * c;
    y[places[1]] += entries[3] * a + entries[1] * b + entries[4] * c;
    y[places[2]] += entries[5] * a + entries[4] * b + entries[2] * c;
  }
};

std::uint32_t place_of(const Places& places, std::uint32_t triangle, std::uint32_t corner) {
  return places.of_corner[triangle][static_cast<int>(corner)];
}

// The slope over an edge on its one side: of the value at the opposite corner above that at the foot of its height.
struct Slope {
  double height;
  double foot;  // from the corner `from` (0) to the corner `to()` (1)

  Slope(const Facet& facet, const EdgeSide& side) {
    const glm::dvec3 from(facet.corner(static_cast<int>(side.from)));
    const glm::dvec3 edge = glm::dvec3(facet.corner(static_cast<int>(side.to()))) - from;
    const glm::dvec3 opposite = glm::dvec3(facet.corner(static_cast<int>(side.opposite()))) - from;
    height = 2 * facet.area() / glm::length(edge);
    foot = glm::dot(opposite, edge) / glm::dot(edge, edge);
  }
};

// What the paper's term of smoothness is about. Squared it counts with the area of both triangles times both heights,
// which makes it independent of the mesh's unit, and bounded for needles.
EdgeBend bend_of(const SharedEdge& edge, const Facet& of_a, const Facet& of_b, const Places& places) {
  const auto& [a, b] = edge.sides;
  const Slope slope_a(of_a, a), slope_b(of_b, b);
  const double one_a = 1 / slope_a.height, one_b = 1 / slope_b.height;
  return {.places = {place_of(places, a.triangle, a.opposite()), place_of(places, b.triangle, b.opposite()),
                     place_of(places, a.triangle, a.from), place_of(places, a.triangle, a.to())},
          // The sides run against each other.
          .coefficients = {one_a, one_b, -(1 - slope_a.foot) * one_a - slope_b.foot * one_b,
                           -slope_a.foot * one_a - (1 - slope_b.foot) * one_b},
          .weight = (of_a.area() + of_b.area()) * slope_a.height * slope_b.height};
}

// Only where both triangles have the same values along the edge, and do not meet in a crease, over which occlusion may
// well bend.
std::vector<EdgeBend> bends_of(const scene::Mesh& mesh, const Places& places, double smoothness) {
  std::vector<EdgeBend> bends;
  if (smoothness == 0) return bends;
  for (const SharedEdge& edge : scene::shared_edges(mesh)) {
    const auto& [a, b] = edge.sides;
    if (place_of(places, a.triangle, a.from) != place_of(places, b.triangle, b.to())) continue;
    if (place_of(places, a.triangle, a.to()) != place_of(places, b.triangle, b.from)) continue;
    const Facet of_a(mesh, mesh.triangles[a.triangle]), of_b(mesh, mesh.triangles[b.triangle]);
    if (glm::dot(of_a.normal(), of_b.normal()) < kSmoothBend) continue;
    bends.push_back(bend_of(edge, of_a, of_b, places));
    bends.back().weight *= smoothness;
  }
  return bends;
}

// The system: A x + smoothness x R x = b.
struct System {
  std::vector<MassBlock> blocks;
  std::vector<EdgeBend> bends;
  std::vector<double> diagonal, right_side;
  std::vector<double> start;  // means of the samples around each place

  void multiply(std::span<const double> x, std::span<double> y) const {
    std::fill(y.begin(), y.end(), 0.0);
    for (const MassBlock& block : blocks) block.multiply_add(x, y);
    for (const EdgeBend& bend : bends) bend.multiply_add(x, y);
  }
};

System make_system(const scene::Mesh& mesh, const Places& places, const FaceSamples& samples,
                   std::span<const float> occlusion, double smoothness) {
  System system{
      .blocks = {}, .bends = bends_of(mesh, places, smoothness), .diagonal = {}, .right_side = {}, .start = {}};
  system.diagonal.resize(places.count);
  system.right_side.resize(places.count);
  std::vector<double> masses(places.count);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t first = samples.firsts[t], end = samples.firsts[t + 1];
    const double weight = Facet(mesh, mesh.triangles[t]).area() / (end - first);
    const glm::uvec3& corners = places.of_corner[t];
    MassBlock block{.places = {corners.x, corners.y, corners.z}};
    for (std::uint32_t i = first; i < end; ++i) {
      if (std::isnan(occlusion[i])) continue;
      block.add(weight, samples.weights[i]);
      for (int corner = 0; corner < 3; ++corner) {
        const double share = weight * samples.weights[i][corner];
        system.right_side[corners[corner]] += share * static_cast<double>(occlusion[i]);
        masses[corners[corner]] += share;
      }
    }
    for (std::size_t corner = 0; corner < 3; ++corner) system.diagonal[block.places[corner]] += block.entries[corner];
    system.blocks.push_back(block);
  }
  for (std::size_t i = 0; i < places.count; ++i) {
    system.start.push_back(masses[i] > 0 ? system.right_side[i] / masses[i] : std::numeric_limits<double>::quiet_NaN());
  }
  for (const EdgeBend& bend : system.bends) {
    for (std::size_t i = 0; i < 4; ++i) {
      system.diagonal[bend.places[i]] += bend.weight * bend.coefficients[i] * bend.coefficients[i];
    }
  }
  return system;
}

}  // namespace

std::vector<float> least_squares_values(const scene::Mesh& mesh, const Places& places, const FaceSamples& samples,
                                        std::span<const float> occlusion, const LeastSquaresOptions& options) {
  const System system = make_system(mesh, places, samples, occlusion, options.smoothness);
  std::vector<double> x = system.start;
  for (double& value : x) value = std::isnan(value) ? 0 : value;
  solve([&](std::span<const double> from, std::span<double> to) { system.multiply(from, to); }, system.diagonal,
        system.right_side, x);
  std::vector<float> values;
  values.reserve(places.count);
  for (std::size_t i = 0; i < places.count; ++i) {
    values.push_back(std::isnan(system.start[i]) ? std::numeric_limits<float>::quiet_NaN()
                                                 : static_cast<float>(std::clamp(x[i], 0.0, 1.0)));
  }
  return values;
}

}  // namespace lkao::bake
