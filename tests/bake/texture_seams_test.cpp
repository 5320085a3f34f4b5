#include "bake/texture_seams.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "bake/padding.h"
#include "bake/texture_meshes.h"
#include "support/sanitized.h"

namespace lkao::bake {
namespace {

constexpr double kStep = 1.0 / 255;

// A sphere on a floor, in a frame inside the map, so that its seam is one: 0.05 of the map from its edge.
Mesh sphere_on_floor() {
  Mesh mesh;
  add_uv_sphere(mesh, 1, 24, 12, {{0.05f, 0.05f}, {0.95f, 0.95f}});
  add_bare_quad(mesh, {{-9, -1, -9}, {-9, -1, 9}, {9, -1, 9}, {9, -1, -9}});
  add_bare_quad(mesh, {{1.5f, -1, -9}, {1.5f, -1, 9}, {1.5f, 4, 9}, {1.5f, 4, -9}});
  return mesh;
}

// On the seam from pole to pole, as a filter shows both sides.
std::vector<double> differences_on_seam(const TextureMap& map) {
  std::vector<double> differences;
  for (int i = 0; i <= 3000; ++i) {
    // Between the rings of triangles at the poles.
    const double v = 0.05 + 0.9 * (1.0 / 12 + 10.0 / 12 * i / 3000);
    differences.push_back(std::abs(shown(map, {0.05f, v}) - shown(map, {0.95f, v})));
  }
  return differences;
}

TEST(TextureSeams, BothSidesOfASphereShowTheSame) {
  const Mesh mesh = sphere_on_floor();
  const int size = tests::unless_sanitized(128, 32);
  TextureOptions options{.width = size, .height = size, .level_seams = false};
  const TextureMap before = bake_map(mesh, options, 64, NormalSource::smooth).maps[0];
  options.level_seams = true;
  const TextureBake baked = bake_map(mesh, options, 64, NormalSource::smooth);
  const TextureMap& after = baked.maps[0];

  const std::vector<double> were = differences_on_seam(before), are = differences_on_seam(after);
  EXPECT_GT(*std::max_element(were.begin(), were.end()), 2 * kStep);
  EXPECT_LE(*std::max_element(are.begin(), are.end()), kStep);
  EXPECT_GT(baked.report.worst_seam_before, 2 * kStep);
  EXPECT_LE(baked.report.worst_seam_after, kStep);
  EXPECT_EQ(baked.report.seam_count, 10u + 2 * 24u);

  // Only next to the seam do values change, and no more than noise did.
  double most = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double u = (x + 0.5) / size, v = (y + 0.5) / size;
      const double reach = 2.5 / size;
      const bool is_inside = std::min(u, 1 - u) > 0.05 + reach && std::min(v, 1 - v) > 0.125 + reach;
      const double change = std::abs(after.occlusion[after.texel(x, y)] - before.occlusion[before.texel(x, y)]);
      if (is_inside) {
        EXPECT_EQ(change, 0) << x << " " << y;
      }
      if (before.coverage[before.texel(x, y)] == 255) most = std::max(most, change);
    }
  }
  EXPECT_LT(most, 0.1);
}

// Charts at an angle to each other and of different density.
TEST(TextureSeams, DensitiesMayDiffer) {
  Mesh mesh;
  add_uv_quad(mesh, {{0, 0, 0}, {0, 0, 4}, {2, 0, 4}, {2, 0, 0}}, {{0.02f, 0.02f}, {0.35f, 0.9f}});
  mesh.positions.insert(mesh.positions.end(), {{2, 0, 0}, {2, 0, 4}, {4, 0, 4}, {4, 0, 0}});
  mesh.triangles.insert(mesh.triangles.end(), {{4, 5, 6}, {4, 6, 7}});
  mesh.uvs.insert(mesh.uvs.end(), {{0.5f, 0.6f}, {0.8f, 0.9f}, {0.95f, 0.75f}, {0.65f, 0.45f}});
  mesh.uv_corners.insert(mesh.uv_corners.end(), {{4, 5, 6}, {4, 6, 7}});
  add_bare_quad(mesh, {{-1, 0.5f, 1}, {5, 0.5f, 1}, {5, 2, 2}, {-1, 2, 2}});
  const TextureBake baked = bake_map(mesh, {.width = 96, .height = 64}, 64);
  EXPECT_EQ(baked.report.seam_count, 1u);
  EXPECT_GT(baked.report.worst_seam_before, 2 * kStep);
  EXPECT_LE(baked.report.worst_seam_after, kStep);
  for (int i = 0; i <= 500; ++i) {
    const double s = i / 500.0;
    const glm::dvec2 a = glm::mix(glm::dvec2(0.02f, 0.02f), glm::dvec2(0.35f, 0.02f), s),
                     b = glm::mix(glm::dvec2(0.5f, 0.6f), glm::dvec2(0.8f, 0.9f), s);
    EXPECT_NEAR(shown(baked.maps[0], a), shown(baked.maps[0], b), kStep) << s;
  }
}

TEST(TextureSeams, OfARoomThatIsDarkStayDark) {
  Mesh mesh;
  add_uv_sphere(mesh, 1, 12, 6, {{0.1f, 0.1f}, {0.9f, 0.9f}});
  mesh = turned(mesh);
  for (glm::uvec3& corners : mesh.uv_corners) corners = {corners.x, corners.z, corners.y};
  const TextureBake baked = bake_map(mesh, {.width = 32, .height = 32}, 64);
  for (const float value : baked.maps[0].occlusion) EXPECT_EQ(value, 1);
}

TEST(TextureSeams, BentNormalsStayUnitVectors) {
  const int size = 32;
  const TextureBake baked =
      bake_map(sphere_on_floor(), {.width = size, .height = size, .bent_normals = BentNormals::object}, 64,
               NormalSource::smooth);
  for (const glm::vec3& normal : baked.maps[0].bent_normals) EXPECT_NEAR(glm::length(normal), 1, 1e-5);
}

}  // namespace
}  // namespace lkao::bake
