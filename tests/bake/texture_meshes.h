// Small meshes with texture coordinates, and how their textures are baked.
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "bake/meshes.h"
#include "bake/texture.h"
#include "scene/shapes.h"

namespace lkao::bake {

// A rectangle of texture coordinates.
struct UvBox {
  glm::vec2 upper_left, lower_right;
};

inline void add_uv_triangle(Mesh& mesh, const std::initializer_list<glm::vec3>& corners,
                            const std::initializer_list<glm::vec2>& uvs) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const auto first_uv = static_cast<std::uint32_t>(mesh.uvs.size());
  mesh.positions.insert(mesh.positions.end(), corners);
  mesh.triangles.emplace_back(first, first + 1, first + 2);
  mesh.uvs.insert(mesh.uvs.end(), uvs);
  mesh.uv_corners.emplace_back(first_uv, first_uv + 1, first_uv + 2);
}

// Corners counter-clockwise seen from the front, the first at the lower left of the box.
inline void add_uv_quad(Mesh& mesh, const std::initializer_list<glm::vec3>& corners, const UvBox& box) {
  add_quad(mesh, corners);
  const auto first = static_cast<std::uint32_t>(mesh.uvs.size());
  const auto& [a, b] = box;
  mesh.uvs.insert(mesh.uvs.end(), {{a.x, b.y}, {b.x, b.y}, {b.x, a.y}, {a.x, a.y}});
  mesh.uv_corners.emplace_back(first, first + 1, first + 2);
  mesh.uv_corners.emplace_back(first, first + 2, first + 3);
}

// Triangles that block, and have no place in the texture.
inline void add_bare_quad(Mesh& mesh, const std::initializer_list<glm::vec3>& corners) {
  add_quad(mesh, corners);
  mesh.uv_corners.insert(mesh.uv_corners.end(), 2, glm::uvec3(scene::kNoUv));
}

// The six faces of a box seen from within, each with a third of the width and half of the height of the map, less a gap
// on all sides.
inline Mesh uv_room(const glm::vec3& size, float gap, bool has_lid = true) {
  const float x = size.x, y = size.y, z = size.z;
  Mesh mesh;
  int number = 0;
  const auto box = [&] {
    const glm::vec2 cell(1.0f / 3, 0.5f), first = cell * glm::vec2(number % 3, number / 3);
    ++number;
    return UvBox{first + gap, first + cell - gap};
  };
  add_uv_quad(mesh, {{0, 0, 0}, {0, 0, z}, {x, 0, z}, {x, 0, 0}}, box());
  add_uv_quad(mesh, {{0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0}}, box());
  add_uv_quad(mesh, {{0, 0, z}, {0, y, z}, {x, y, z}, {x, 0, z}}, box());
  add_uv_quad(mesh, {{0, 0, 0}, {0, y, 0}, {0, y, z}, {0, 0, z}}, box());
  add_uv_quad(mesh, {{x, 0, 0}, {x, 0, z}, {x, y, z}, {x, y, 0}}, box());
  if (has_lid) add_uv_quad(mesh, {{0, y, 0}, {x, y, 0}, {x, y, z}, {0, y, z}}, box());
  return mesh;
}

// The usual unwrapping of a sphere around the origin: u runs around, v from the upper pole to the lower one. Its seam
// runs from pole to pole, and every triangle at a pole has a corner of its own there.
inline void add_uv_sphere(Mesh& mesh, double radius, int segments, int rings, const UvBox& box = {{0, 0}, {1, 1}}) {
  const auto place = [&](int i, int j) {
    const double pitch = 0.5 * j / rings;
    const glm::dvec2 down = scene::unit_circle(pitch),
                     around = scene::unit_circle(static_cast<double>(i % segments) / segments);
    const double at_pole = j == 0 || j == rings ? 0 : down.y;
    return glm::vec3(radius * glm::dvec3(at_pole * around.x, down.x, -at_pole * around.y));
  };
  const auto uv = [&](double i, int j) {
    return box.upper_left +
           (box.lower_right - box.upper_left) *
               glm::vec2(static_cast<float>(i / segments), static_cast<float>(j) / static_cast<float>(rings));
  };
  for (int j = 0; j < rings; ++j) {
    for (int i = 0; i < segments; ++i) {
      const glm::vec3 a = place(i, j), b = place(i, j + 1), c = place(i + 1, j + 1), d = place(i + 1, j);
      if (j + 1 < rings) {
        add_uv_triangle(mesh, {a, b, c}, {uv(j == 0 ? i + 0.5 : i, j), uv(i, j + 1), uv(i + 1, j + 1)});
      }
      if (j > 0)
        add_uv_triangle(mesh, {a, c, d}, {uv(i, j), uv(j + 1 == rings ? i + 0.5 : i + 1, j + 1), uv(i + 1, j)});
    }
  }
}

inline Ask ask_of(const AmbientOcclusion& ao) {
  return [&ao](std::span<const Receiver> receivers, const QueryOutputs& outputs, std::uint64_t first_index) {
    ao.query(receivers, outputs, first_index);
  };
}

// Blocked by itself alone.
inline AmbientOcclusion query_of(const Mesh& mesh, int ray_count = 256, float radius = 1000) {
  return {OccluderBvh(mesh.view()), SamplePattern::standard(ray_count), {.radius = radius}};
}

inline TextureBake bake_map(const Mesh& mesh, const TextureOptions& options, int ray_count = 256,
                            NormalSource source = NormalSource::facet, float radius = 1000) {
  const AmbientOcclusion ao = query_of(mesh, ray_count, radius);
  return bake_texture(CornerNormals(mesh, source), scene::bounds_of(mesh), options, ask_of(ao));
}

// As a bilinear filter shows a map that does not repeat.
inline double shown(const TextureMap& map, const glm::dvec2& uv) {
  const double x = uv.x * map.width - 0.5, y = uv.y * map.height - 0.5;
  const auto at = [&map](double column, double row) {
    const int i = static_cast<int>(std::fmin(std::fmax(column, 0), map.width - 1));
    const int j = static_cast<int>(std::fmin(std::fmax(row, 0), map.height - 1));
    return static_cast<double>(map.occlusion[map.texel(i, j)]);
  };
  const double i = std::floor(x), j = std::floor(y), s = x - i, t = y - j;
  return (1 - t) * ((1 - s) * at(i, j) + s * at(i + 1, j)) + t * ((1 - s) * at(i, j + 1) + s * at(i + 1, j + 1));
}

}  // namespace lkao::bake
