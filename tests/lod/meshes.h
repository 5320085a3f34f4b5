// Small meshes for the tests of levels of detail.
#pragma once

#include <cmath>
#include <numbers>

#include "scene/mesh.h"
#include "scene/shapes.h"

namespace lkao::lod {

// `count` x `count` squares over [0, 1] x [0, 1], at the height of a function of x and z; vertices shared.
template <typename Height>
scene::Mesh grid(unsigned count, Height height) {
  scene::Mesh mesh;
  const float step = 1.0f / static_cast<float>(count);
  for (unsigned j = 0; j <= count; ++j) {
    for (unsigned i = 0; i <= count; ++i) {
      const float x = static_cast<float>(i) * step, z = static_cast<float>(j) * step;
      mesh.positions.emplace_back(x, height(x, z), z);
    }
  }
  for (unsigned j = 0; j < count; ++j) {
    for (unsigned i = 0; i < count; ++i) {
      const unsigned a = j * (count + 1) + i, b = a + 1, c = a + count + 1, d = c + 1;
      mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {b, c, d}});
    }
  }
  return mesh;
}

inline scene::Mesh flat_grid(unsigned count) {
  return grid(count, [](float, float) { return 0.0f; });
}

inline scene::Mesh wavy_grid(unsigned count) {
  return grid(count, [](float x, float z) { return 0.05f * std::sin(9 * x) * std::cos(7 * z); });
}

inline scene::Mesh ball(double radius, int segment_count) {
  scene::Mesh mesh;
  scene::add_sphere(mesh, {0, 0, 0}, radius, segment_count, segment_count / 2);
  return mesh;
}

}  // namespace lkao::lod
