#include "bake/tangent_frames.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "bake/texture_meshes.h"
#include "scene/facet.h"

namespace lkao::bake {
namespace {

void expect_close(const glm::vec3& a, const glm::vec3& b, float distance) { EXPECT_LT(glm::distance(a, b), distance); }

// u runs around the axis: its direction at a point of a sphere is known. The poles' triangles are left out.
TEST(TangentFrames, FollowUAroundASphere) {
  for (const bool is_mirrored : {false, true}) {
    Mesh mesh;
    add_uv_sphere(mesh, 1, 48, 24, is_mirrored ? UvBox{{1, 0}, {0, 1}} : UvBox{{0, 0}, {1, 1}});
    const CornerNormals normals(mesh, NormalSource::smooth);
    const TextureLayout layout(normals, {});
    const TangentFrames frames(layout);
    for (std::uint32_t t = 48; t + 48 < mesh.triangles.size(); t += 7) {
      const glm::dvec3 weights(0.2, 0.5, 0.3);
      const glm::mat3 frame = frames.at(t, weights);
      EXPECT_NEAR(glm::determinant(frame), is_mirrored ? -1 : 1, 1e-5);
      const scene::Facet facet(mesh, mesh.triangles[t]);
      const glm::vec3 place = 0.2f * facet.a + 0.5f * facet.b + 0.3f * facet.c;
      const glm::vec3 around = glm::normalize(glm::cross(glm::vec3(0, 1, 0), place));
      expect_close(frame[0], is_mirrored ? -around : around, 0.1f);
      expect_close(frame[2], glm::normalize(place), 0.05f);
      EXPECT_GT(frame[1].y, 0);
    }
  }
}

// On both sides of an inner edge the tangents are the same ones.
TEST(TangentFrames, AreSmoothWhereTheTextureGoesOn) {
  Mesh mesh;
  add_uv_sphere(mesh, 1, 24, 12);
  const CornerNormals normals(mesh, NormalSource::smooth);
  const TextureLayout layout(normals, {});
  const TangentFrames frames(layout);
  std::size_t compared = 0;
  for (const scene::SharedEdge& edge : scene::shared_edges(mesh)) {
    if (!layout.has_same_uvs(edge)) continue;
    const auto& [a, b] = edge.sides;
    glm::dvec3 at_a(0.0), at_b(0.0);
    at_a[static_cast<int>(a.from)] = at_b[static_cast<int>(b.to())] = 0.25;
    at_a[static_cast<int>(a.to())] = at_b[static_cast<int>(b.from)] = 0.75;
    for (int i = 0; i < 3; ++i) expect_close(frames.at(a.triangle, at_a)[i], frames.at(b.triangle, at_b)[i], 1e-5f);
    ++compared;
  }
  EXPECT_GT(compared, 500u);
}

}  // namespace
}  // namespace lkao::bake
