// Building blocks of the built-in scenes. Everything is made of IEEE additions, products, quotients and square roots
// alone, so that the same code makes the same bits on every machine (compile with -ffp-contract=off). Fronts are the
// outsides of solids unless said otherwise. Lengths in scene units, angles in turns.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "scene/mesh.h"

namespace lkao::scene {

// A small generator of random numbers (SplitMix64): the standard library's distributions differ between machines.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits();
  double uniform();                         // [0, 1)
  double uniform(double low, double high);  // [low, high)
  int below(int count);                     // 0 ... count - 1
  glm::dvec3 unit_vector();

 private:
  std::uint64_t state_;
};

// (cos, sin) of an angle in turns, to some 1e-15.
glm::dvec2 unit_circle(double turns);

// Lays a surface (u, v, height) out in space.
using Placement = std::function<glm::dvec3(double u, double v, double height)>;

// Corners counter-clockwise seen from the front.
void add_triangle(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);
void add_quad(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

// All six faces of an axis-aligned box.
void add_box(Mesh& mesh, const glm::dvec3& lower, const glm::dvec3& upper);

// A grid of points with row_size points a row; quads between neighbours. Front: row direction x column direction.
void add_grid(Mesh& mesh, std::span<const glm::dvec3> points, std::size_t row_size);

// A profile (radius, height) turned around the vertical axis through `base`, listed from bottom to top along the
// outside. Where the radius is 0 the fan closes in one point. `radius_at(turns)` scales the radius, for flutes.
void add_revolved(Mesh& mesh, const glm::dvec3& base, std::span<const glm::dvec2> profile, int segment_count,
                  const std::function<double(double)>& radius_at = {});

void add_sphere(Mesh& mesh, const glm::dvec3& center, double radius, int segment_count, int ring_count);

// A closed profile (counter-clockwise seen against the path's direction) swept along a path; profile.x along `side`,
// profile.y along `up` of each station. Both ends are closed by a fan (star-shaped profiles only).
struct Station {
  glm::dvec3 origin;
  glm::dvec3 side;
  glm::dvec3 up;
};
void add_swept(Mesh& mesh, std::span<const Station> path, std::span<const glm::dvec2> profile);

// A stepped relief over the cells of a grid: cell (i, j) between us[i], us[i + 1] and vs[j], vs[j + 1] lies at
// height_at(i, j); upright walls join cells of different height, so the relief has no gaps. Front: u x v.
void add_relief(Mesh& mesh, std::span<const double> us, std::span<const double> vs,
                const std::function<double(std::size_t, std::size_t)>& height_at, const Placement& place);

// A flat wall panel (u, v) with an arched opening from `sill` up: upright sides to `spring`, a half circle above.
// Height 0 of `place` is the wall's face; front: u x v.
struct ArchedOpening {
  double center;
  double radius;
  double sill;
  double spring;
};
void add_arched_panel(Mesh& mesh, const glm::dvec2& lower, const glm::dvec2& upper, const ArchedOpening& opening,
                      int segment_count, const Placement& place);

// The hollow behind such an opening: a half cylinder with a half dome on top and a floor, seen from within.
void add_niche(Mesh& mesh, const ArchedOpening& opening, int segment_count, const Placement& place);

// The inner side of an arch, from height 0 to -depth, with the upright sides from the sill.
void add_soffit(Mesh& mesh, const ArchedOpening& opening, double depth, int segment_count, const Placement& place);

}  // namespace lkao::scene
