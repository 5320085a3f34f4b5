#include "scene/shapes.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace lkao::scene {

namespace {

std::uint32_t add_vertex(Mesh& mesh, const glm::dvec3& position) {
  mesh.positions.emplace_back(position);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

// Taylor series for |x| <= pi / 4.
glm::dvec2 small_angle(double x) {
  const double x2 = x * x;
  double cosine = 1;
  double sine = 1;
  for (int n = 18; n >= 2; n -= 2) {
    cosine = 1 - cosine * x2 / (n * (n - 1));
    sine = 1 - sine * x2 / (n * (n + 1));
  }
  return {cosine, x * sine};
}

// Points of a half circle from the right (turn 0) to the left (turn 1/2).
std::vector<glm::dvec2> half_circle(const glm::dvec2& center, double radius, int segment_count) {
  std::vector<glm::dvec2> points;
  for (int i = 0; i <= segment_count; ++i) {
    points.push_back(center + radius * unit_circle(0.5 * i / segment_count));
  }
  return points;
}

}  // namespace

std::uint64_t Random::bits() {
  state_ += 0x9e3779b97f4a7c15u;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

double Random::uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
double Random::uniform(double low, double high) { return low + (high - low) * uniform(); }
int Random::below(int count) { return static_cast<int>(uniform() * count); }

glm::dvec3 Random::unit_vector() {
  while (true) {
    const double x = uniform(-1, 1);
    const double y = uniform(-1, 1);
    const double z = uniform(-1, 1);
    const double length2 = x * x + y * y + z * z;
    if (length2 > 0.01 && length2 <= 1) return glm::dvec3(x, y, z) / std::sqrt(length2);
  }
}

glm::dvec2 unit_circle(double turns) {
  const double quarter_count = std::floor(4 * turns + 0.5);
  constexpr double kQuarterTurn = 1.5707963267948966;
  const glm::dvec2 p = small_angle((4 * turns - quarter_count) * kQuarterTurn);
  switch (static_cast<int>(quarter_count - 4 * std::floor(quarter_count / 4))) {
    case 0:
      return p;
    case 1:
      return {-p.y, p.x};
    case 2:
      return -p;
    default:
      return {p.y, -p.x};
  }
}

void add_triangle(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const std::uint32_t first = add_vertex(mesh, a);
  add_vertex(mesh, b);
  add_vertex(mesh, c);
  mesh.triangles.emplace_back(first, first + 1, first + 2);
}

void add_quad(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  const std::uint32_t first = add_vertex(mesh, a);
  add_vertex(mesh, b);
  add_vertex(mesh, c);
  add_vertex(mesh, d);
  mesh.triangles.emplace_back(first, first + 1, first + 2);
  mesh.triangles.emplace_back(first, first + 2, first + 3);
}

void add_box(Mesh& mesh, const glm::dvec3& lower, const glm::dvec3& upper) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int i = 0; i < 8; ++i) {
    add_vertex(mesh,
               {(i & 1) != 0 ? upper.x : lower.x, (i & 2) != 0 ? upper.y : lower.y, (i & 4) != 0 ? upper.z : lower.z});
  }
  constexpr glm::uvec4 kFaces[] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const glm::uvec4& face : kFaces) {
    mesh.triangles.emplace_back(first + face.x, first + face.y, first + face.z);
    mesh.triangles.emplace_back(first + face.x, first + face.z, first + face.w);
  }
}

void add_grid(Mesh& mesh, std::span<const glm::dvec3> points, std::size_t row_size) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const auto width = static_cast<std::uint32_t>(row_size);
  const auto height = static_cast<std::uint32_t>(points.size() / row_size);
  for (const glm::dvec3& point : points) add_vertex(mesh, point);
  for (std::uint32_t row = 0; row + 1 < height; ++row) {
    for (std::uint32_t column = 0; column + 1 < width; ++column) {
      const std::uint32_t a = first + row * width + column;
      mesh.triangles.emplace_back(a, a + 1, a + width + 1);
      mesh.triangles.emplace_back(a, a + width + 1, a + width);
    }
  }
}

void add_revolved(Mesh& mesh, const glm::dvec3& base, std::span<const glm::dvec2> profile, int segment_count,
                  const std::function<double(double)>& radius_at) {
  const auto segments = static_cast<std::uint32_t>(segment_count);
  std::vector<std::uint32_t> rings;  // first vertex of each
  for (const glm::dvec2& point : profile) {
    rings.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    const bool is_pole = point.x == 0;
    for (int i = 0; i < (is_pole ? 1 : segment_count); ++i) {
      const double turns = static_cast<double>(i) / segment_count;
      const double radius = point.x * (radius_at ? radius_at(turns) : 1.0);
      const glm::dvec2 circle = radius * unit_circle(turns);
      add_vertex(mesh, base + glm::dvec3(circle.x, point.y, -circle.y));
    }
  }
  for (std::size_t ring = 0; ring + 1 < rings.size(); ++ring) {
    for (std::uint32_t i = 0; i < segments; ++i) {
      const std::uint32_t next = (i + 1) % segments;
      const bool low_is_pole = profile[ring].x == 0;
      const bool high_is_pole = profile[ring + 1].x == 0;
      const std::uint32_t low = rings[ring];
      const std::uint32_t high = rings[ring + 1];
      if (!low_is_pole) mesh.triangles.emplace_back(low + i, low + next, high_is_pole ? high : high + next);
      if (!high_is_pole) mesh.triangles.emplace_back(low_is_pole ? low : low + i, high + next, high + i);
    }
  }
}

void add_sphere(Mesh& mesh, const glm::dvec3& center, double radius, int segment_count, int ring_count) {
  std::vector<glm::dvec2> profile = {{0, -radius}};
  for (int ring = 1; ring < ring_count; ++ring) {
    profile.push_back(radius * unit_circle(0.5 * ring / ring_count - 0.25));
  }
  profile.emplace_back(0, radius);
  add_revolved(mesh, center, profile, segment_count);
}

void add_swept(Mesh& mesh, std::span<const Station> path, std::span<const glm::dvec2> profile) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const auto size = static_cast<std::uint32_t>(profile.size());
  for (const Station& station : path) {
    for (const glm::dvec2& p : profile) add_vertex(mesh, station.origin + p.x * station.side + p.y * station.up);
  }
  const auto last = first + size * static_cast<std::uint32_t>(path.size() - 1);
  for (std::uint32_t ring = first; ring < last; ring += size) {
    for (std::uint32_t i = 0; i < size; ++i) {
      const std::uint32_t next = (i + 1) % size;
      mesh.triangles.emplace_back(ring + i, ring + size + i, ring + size + next);
      mesh.triangles.emplace_back(ring + i, ring + size + next, ring + next);
    }
  }
  for (std::uint32_t i = 2; i < size; ++i) {
    mesh.triangles.emplace_back(first, first + i - 1, first + i);
    mesh.triangles.emplace_back(last, last + i, last + i - 1);
  }
}

void add_relief(Mesh& mesh, std::span<const double> us, std::span<const double> vs,
                const std::function<double(std::size_t, std::size_t)>& height_at, const Placement& place) {
  for (std::size_t j = 0; j + 1 < vs.size(); ++j) {
    for (std::size_t i = 0; i + 1 < us.size(); ++i) {
      const double h = height_at(i, j);
      add_quad(mesh, place(us[i], vs[j], h), place(us[i + 1], vs[j], h), place(us[i + 1], vs[j + 1], h),
               place(us[i], vs[j + 1], h));
      // The wall towards the next cell in u and in v faces the lower of the two.
      if (i + 2 < us.size() && height_at(i + 1, j) != h) {
        const double next = height_at(i + 1, j);
        const double u = us[i + 1];
        add_quad(mesh, place(u, vs[j], next), place(u, vs[j + 1], next), place(u, vs[j + 1], h), place(u, vs[j], h));
      }
      if (j + 2 < vs.size() && height_at(i, j + 1) != h) {
        const double next = height_at(i, j + 1);
        const double v = vs[j + 1];
        add_quad(mesh, place(us[i + 1], v, next), place(us[i], v, next), place(us[i], v, h), place(us[i + 1], v, h));
      }
    }
  }
}

void add_arched_panel(Mesh& mesh, const glm::dvec2& lower, const glm::dvec2& upper, const ArchedOpening& opening,
                      int segment_count, const Placement& place) {
  const double left = opening.center - opening.radius;
  const double right = opening.center + opening.radius;
  const auto add_rectangle = [&](double u0, double v0, double u1, double v1) {
    if (u0 < u1 && v0 < v1) add_quad(mesh, place(u0, v0, 0), place(u1, v0, 0), place(u1, v1, 0), place(u0, v1, 0));
  };
  add_rectangle(lower.x, lower.y, left, upper.y);
  add_rectangle(right, lower.y, upper.x, upper.y);
  add_rectangle(left, lower.y, right, opening.sill);
  const std::vector<glm::dvec2> arch = half_circle({opening.center, opening.spring}, opening.radius, segment_count);
  for (std::size_t i = 0; i + 1 < arch.size(); ++i) {
    const glm::dvec2& a = arch[i];
    const glm::dvec2& b = arch[i + 1];
    add_quad(mesh, place(b.x, b.y, 0), place(a.x, a.y, 0), place(a.x, upper.y, 0), place(b.x, upper.y, 0));
  }
}

void add_niche(Mesh& mesh, const ArchedOpening& opening, int segment_count, const Placement& place) {
  const double r = opening.radius;
  const double u0 = opening.center;
  // The dome: meridians from the wall at the right to the wall at the left, each from the springing to the crown.
  const int ring_count = segment_count / 2;
  const auto dome = [&](int segment, int ring) {
    const glm::dvec2 around = unit_circle(0.5 * segment / segment_count);
    const glm::dvec2 upwards = unit_circle(0.25 * ring / ring_count);
    return place(u0 + r * upwards.x * around.x, opening.spring + r * upwards.y, -r * upwards.x * around.y);
  };
  for (int i = 0; i < segment_count; ++i) {
    const glm::dvec2 a = unit_circle(0.5 * i / segment_count);
    const glm::dvec2 b = unit_circle(0.5 * (i + 1) / segment_count);
    const auto on_wall = [&](const glm::dvec2& p, double v) { return place(u0 + r * p.x, v, -r * p.y); };
    add_quad(mesh, on_wall(b, opening.sill), on_wall(a, opening.sill), on_wall(a, opening.spring),
             on_wall(b, opening.spring));
    add_triangle(mesh, place(u0, opening.sill, 0), on_wall(a, opening.sill), on_wall(b, opening.sill));
    for (int ring = 0; ring + 1 < ring_count; ++ring) {
      add_quad(mesh, dome(i + 1, ring), dome(i, ring), dome(i, ring + 1), dome(i + 1, ring + 1));
    }
    add_triangle(mesh, dome(i + 1, ring_count - 1), dome(i, ring_count - 1), place(u0, opening.spring + r, 0));
  }
}

void add_soffit(Mesh& mesh, const ArchedOpening& opening, double depth, int segment_count, const Placement& place) {
  std::vector<glm::dvec2> outline = {{opening.center + opening.radius, opening.sill}};
  for (const glm::dvec2& p : half_circle({opening.center, opening.spring}, opening.radius, segment_count)) {
    if (p != outline.back()) outline.push_back(p);
  }
  if (opening.sill != opening.spring) outline.emplace_back(opening.center - opening.radius, opening.sill);
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
    const glm::dvec2& a = outline[i];
    const glm::dvec2& b = outline[i + 1];
    add_quad(mesh, place(a.x, a.y, 0), place(b.x, b.y, 0), place(b.x, b.y, -depth), place(a.x, a.y, -depth));
  }
}

}  // namespace lkao::scene
