#include "bvh/scene_query.h"

namespace lkao::bvh {

bool is_blocked_by(const SceneLayout& scene, const Query& query, std::uint32_t instance, std::uint32_t primitive,
                   int ray) {
  const Query own = query_of_instance(scene, query, instance, query.open);
  const Layout& mesh = scene.mesh_of(scene.placements[instance]);
  const TriangleTest test = make_test(mesh, primitive, own);
  return test.can_block() && blocks(test, mesh, primitive, own, ray);
}

}  // namespace lkao::bvh
