#include "raster/small_scene.h"

#include "lut/random.h"
#include "support/meshes.h"

namespace lkao::raster::tests {

using lkao::tests::add_quad;
using lkao::tests::random_point;
using lkao::tests::uniform;

scene::Mesh small_scene() {
  lkao::tests::Mesh mesh;
  add_quad(mesh, {-1, 0, 1}, {2, 0.3f, 0}, {0, 0, -2});
  add_quad(mesh, {-1, 0, 1}, {0, 0, -2}, {0.2f, 1.2f, 0});
  lut::RandomStream random(3);
  for (int i = 0; i < 120; ++i) {
    const glm::vec3 center = random_point(random, 1.0f) * glm::vec3(0.8f, 0.3f, 0.8f) + glm::vec3(0, 0.55f, 0);
    const float size = 0.02f + 0.3f * uniform(random, 0, 1);
    const auto first = static_cast<unsigned>(mesh.positions.size());
    for (int k = 0; k < 3; ++k) mesh.positions.push_back(center + random_point(random, size));
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return {mesh.positions, mesh.triangles};
}

scene::Camera small_camera() { return {{1.2f, 1.8f, 2.4f}, {0.05f, 0.45f, -0.1f}, {0.15f, 1, 0}, 62}; }

}  // namespace lkao::raster::tests
