#include "fuzz/soup.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lkao::tests {
namespace {

constexpr std::size_t kMaxTriangleCount = 300;

// Sizes at which a mesh may come, the common ones more often.
constexpr float kScales[] = {1, 1, 1, 1, 1e-3f, 1e3f, 1e-6f, 1e6f};
// Products of a few lengths underflow or overflow in single precision.
constexpr float kWildScales[] = {1e-12f, 1e-9f, 1, 1, 1e9f, 1e12f};
constexpr float kOffsets[] = {0, 0, 0, 1, 100, 1e4f, 1e6f};

class SoupMaker {
 public:
  SoupMaker(ByteSource& bytes, bool is_wild) : bytes_(bytes), is_wild_(is_wild) {
    soup_.on_grid = bytes_.once_in(3);
    soup_.placement.scale = is_wild_ ? bytes_.pick(kWildScales) : bytes_.pick(kScales);
    const glm::vec3 octant = glm::sign(bytes_.point());
    soup_.placement.offset = octant * bytes_.pick(kOffsets);
  }

  Soup make() {
    const std::uint32_t shape_count = bytes_.below(32);
    for (std::uint32_t i = 0; i < shape_count && mesh().triangles.size() < kMaxTriangleCount; ++i) add_shape();
    for (glm::vec3& p : mesh().positions) p = soup_.placement.place(p);
    if (is_wild_ || bytes_.once_in(4)) spoil();
    return soup_;
  }

 private:
  Mesh& mesh() { return soup_.mesh; }
  glm::vec3 point() { return soup_point(bytes_, soup_.on_grid); }
  glm::uvec3 any_triangle() { return mesh().triangles[bytes_.below(mesh().triangles.size())]; }
  std::uint32_t any_vertex() { return bytes_.below(mesh().positions.size()); }

  std::uint32_t add_vertex(const glm::vec3& p) {
    mesh().positions.push_back(p);
    return static_cast<std::uint32_t>(mesh().positions.size() - 1);
  }
  void add_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const std::uint32_t first = add_vertex(a);
    add_vertex(b);
    add_vertex(c);
    mesh().triangles.emplace_back(first, first + 1, first + 2);
  }

  void add_shape() {
    switch (bytes_.below(10)) {
      case 0:
        return add_sliver();
      case 1:
        return add_axis_aligned_quad();
      case 2:
        return add_fan();
      case 3:
        return add_zero_area();
      case 4:
        return add_coplanar_neighbour();
      case 5:
        return add_over_shared_vertices();
      case 6:
        return add_copy();
      case 7:
      case 8:
        return add_cloud();
      default: {
        const glm::vec3 a = point(), b = point();
        return add_triangle(a, b, point());
      }
    }
  }

  // Down to what single precision cannot tell from a line.
  void add_sliver() {
    const glm::vec3 a = point(), b = point();
    const float thickness = std::pow(10.0f, -8 * bytes_.share());
    add_triangle(a, b, b + bytes_.point() * thickness);
  }

  void add_axis_aligned_quad() {
    const auto axis = static_cast<int>(bytes_.below(3));
    const glm::vec3 corner = point(), diagonal = point() - corner;
    glm::vec3 u(0), v(0);
    u[(axis + 1) % 3] = diagonal[(axis + 1) % 3];
    v[(axis + 2) % 3] = diagonal[(axis + 2) % 3];
    add_quad(mesh(), corner, u, v);
  }

  // Many triangles that share a corner, each an edge with the next.
  void add_fan() {
    const std::uint32_t center = add_vertex(point());
    const std::uint32_t blade_count = 2 + bytes_.below(30);
    const glm::vec3 u = bytes_.point(), v = bytes_.point();
    for (std::uint32_t i = 0; i <= blade_count; ++i) {
      const float turn = 6.2831853f * static_cast<float>(i) / static_cast<float>(blade_count);
      const glm::vec3 middle = mesh().positions[center];
      const std::uint32_t rim = add_vertex(middle + u * std::cos(turn) + v * std::sin(turn));
      if (i > 0) mesh().triangles.emplace_back(center, rim - 1, rim);
    }
  }

  // Two equal corners, or three on one line (to rounding).
  void add_zero_area() {
    const glm::vec3 a = point(), b = point();
    add_triangle(a, b, bytes_.once_in(2) ? a : glm::mix(a, b, bytes_.share()));
  }

  // Over the edge of a triangle: in its plane to rounding, overlapping or not.
  void add_coplanar_neighbour() {
    if (mesh().triangles.empty()) return;
    const glm::uvec3 t = any_triangle();
    const glm::vec3 a = mesh().positions[t.x], b = mesh().positions[t.y], c = mesh().positions[t.z];
    const float along = bytes_.coordinate(), away = bytes_.coordinate();
    mesh().triangles.emplace_back(t.y, t.x, add_vertex(a + along * (b - a) + away * (c - a)));
  }

  void add_over_shared_vertices() {
    if (mesh().positions.empty()) return;
    const std::uint32_t a = any_vertex(), b = any_vertex();
    mesh().triangles.emplace_back(a, b, any_vertex());
  }

  // Coincident, perhaps facing the other way.
  void add_copy() {
    if (mesh().triangles.empty()) return;
    const glm::uvec3 t = any_triangle();
    mesh().triangles.push_back(bytes_.once_in(2) ? glm::uvec3(t.z, t.y, t.x) : t);
  }

  // Small triangles around a point, enough for several nodes.
  void add_cloud() {
    const glm::vec3 center = point();
    const float size = std::pow(10.0f, -2 * bytes_.share());
    const std::uint32_t count = bytes_.below(64);
    lut::RandomStream random(bytes_.next_byte());
    for (std::uint32_t i = 0; i < count; ++i) {
      const glm::vec3 a = center + random_point(random, size), b = a + random_point(random, size);
      add_triangle(a, b, a + random_point(random, size));
    }
  }

  // Coordinates that no mesh should have.
  void spoil() {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kBad[] = {std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity, 1e-38f, 1e-45f, 0, -0.0f};
    constexpr float kHuge[] = {kLargest, -kLargest};
    const std::uint32_t count = mesh().positions.empty() ? 0 : 1 + bytes_.below(4);
    for (std::uint32_t i = 0; i < count; ++i) {
      glm::vec3& p = mesh().positions[any_vertex()];
      p[static_cast<int>(bytes_.below(3))] = is_wild_ ? bytes_.pick(kHuge) : bytes_.pick(kBad);
    }
  }

  ByteSource& bytes_;
  bool is_wild_;
  Soup soup_;
};

}  // namespace

glm::vec3 soup_point(ByteSource& bytes, bool on_grid) {
  const glm::vec3 p = bytes.point();
  return on_grid ? glm::round(p * 4.0f) / 4.0f : p;
}

glm::vec3 raw_point(ByteSource& bytes) {
  glm::vec3 p;
  for (int axis = 0; axis < 3; ++axis) {
    const float value = bytes.any_float();
    p[axis] = std::isfinite(value) ? std::clamp(value, -kLargest, kLargest) : value;
  }
  return p;
}

Soup make_soup(ByteSource& bytes, bool is_wild) { return SoupMaker(bytes, is_wild).make(); }

}  // namespace lkao::tests
