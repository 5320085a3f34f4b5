#include "bake/cage.h"

#include <cmath>

#include <gtest/gtest.h>

#include "bake/texture_meshes.h"

namespace lkao::bake {
namespace {

// A floor before a wall of height 1.
Mesh detailed_floor() {
  Mesh mesh;
  add_quad(mesh, {{-1, 0, 2}, {2, 0, 2}, {2, 0, 0}, {-1, 0, 0}});
  add_quad(mesh, {{-50, 0, 0}, {50, 0, 0}, {50, 1, 0}, {-50, 1, 0}});
  return mesh;
}

// Above it, and what its texture shows of the detailed one.
Mesh simple_floor() {
  Mesh mesh;
  add_uv_quad(mesh, {{0, 0.1f, 1}, {1, 0.1f, 1}, {1, 0.1f, 0}, {0, 0.1f, 0}}, {{0, 0}, {1, 1}});
  return mesh;
}

TextureBake bake_by_cage(const Mesh& simple, const Mesh& detailed, double extrusion) {
  const CornerNormals of_detailed(detailed, NormalSource::facet), of_simple(simple, NormalSource::facet);
  const Cage cage(of_detailed, simple, extrusion);
  const AmbientOcclusion ao = query_of(detailed, 256, 1e5f);
  return bake_texture(of_simple, scene::bounds_of(detailed), {.width = 32, .height = 32, .cage = &cage}, ask_of(ao));
}

TEST(Cage, ShowsTheOcclusionOfTheDetailedMesh) {
  const TextureBake baked = bake_by_cage(simple_floor(), detailed_floor(), 0.5);
  EXPECT_EQ(baked.report.missed_receiver_count, 0u);
  const TextureMap& map = baked.maps[0];
  for (int y = 0; y < 32; ++y) {
    const double height = 32 / (y + 0.5);  // of the wall, over the distance from it
    for (int x = 0; x < 32; ++x) {
      EXPECT_NEAR(map.occlusion[map.texel(x, y)], 0.5 * (1 - 1 / std::sqrt(1 + height * height)), 0.03);
    }
  }
}

// The first of the detailed mesh that faces the shell.
TEST(Cage, LooksThroughBacks) {
  Mesh detailed = detailed_floor();
  add_quad(detailed, {{-1, 0.3f, -1}, {2, 0.3f, -1}, {2, 0.3f, 2}, {-1, 0.3f, 2}});  // seen from below
  const CornerNormals of_detailed(detailed, NormalSource::facet);
  const Mesh simple = simple_floor();
  const auto height_at = [&](const CornerNormals& normals) {
    return Cage(normals, simple, 0.5).receiver(0, glm::dvec3(1.0 / 3), 1e-4).value().position.y;
  };
  EXPECT_NEAR(height_at(of_detailed), 0, 1e-6);
  Mesh covered = detailed_floor();
  add_quad(covered, {{-1, 0.3f, 2}, {2, 0.3f, 2}, {2, 0.3f, -1}, {-1, 0.3f, -1}});  // seen from above
  EXPECT_NEAR(height_at(CornerNormals(covered, NormalSource::facet)), 0.3, 1e-6);
}

TEST(Cage, CountsWhereThereIsNothing) {
  Mesh detailed;
  add_quad(detailed, {{0, 0, 1}, {0.5f, 0, 1}, {0.5f, 0, 0}, {0, 0, 0}});
  const TextureBake baked = bake_by_cage(simple_floor(), detailed, 0.5);
  EXPECT_NEAR(static_cast<double>(baked.report.missed_receiver_count),
              0.5 * static_cast<double>(baked.report.receiver_count), 40);
  // Too far away for so thin a shell.
  EXPECT_EQ(bake_by_cage(simple_floor(), detailed, 0.05).report.missed_receiver_count, baked.report.receiver_count);
}

TEST(Cage, RefusesAnExtrusionOutOfRange) {
  const Mesh mesh = simple_floor();
  const CornerNormals normals(mesh, NormalSource::facet);
  for (const double extrusion : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(Cage(normals, mesh, extrusion), std::invalid_argument) << extrusion;
  }
}

}  // namespace
}  // namespace lkao::bake
