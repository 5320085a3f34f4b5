// Differs from the paper, whose masks come from a table (table_kernel.cpp): node masks come from slab tests of single
// rays and triangle masks from TriangleTest, so the result is exact.
#include "bvh/scalar_kernel.h"

#include "bvh/ray_triangle.h"
#include "bvh/traversal.h"

namespace lkao::bvh {
namespace {

class ScalarKernel {
 public:
  explicit ScalarKernel(const Query& query) : query_(query), word_count_(query.rays.word_count()) {
    for (int i = 0; i < query.rays.ray_count; ++i) box_rays_[i] = BoxRay(query.rays.ray(i));
  }

  OcclusionMask node_mask(const Bounds& box, const OcclusionMask& mask) const {
    OcclusionMask met;
    for_each_ray(mask, word_count_, [&](int ray) {
      if (may_meet(box_rays_[ray], query_.rays.origin, box, begin(ray), end(ray))) met.set(ray);
    });
    return met;
  }

  OcclusionMask triangle_mask(const Layout& layout, const Query& query, std::uint32_t primitive,
                              const OcclusionMask& mask) const {
    OcclusionMask blocked;
    const TriangleTest test = make_test(layout, primitive, query);
    if (!test.can_block()) return blocked;
    for_each_ray(mask, word_count_, [&](int ray) {
      if (blocks(test, layout, primitive, query, ray)) blocked.set(ray);
    });
    return blocked;
  }

 private:
  float begin(int ray) const { return query_.parts != nullptr ? query_.parts->begin[ray] : 0.0f; }
  float end(int ray) const { return query_.parts != nullptr ? query_.parts->end[ray] : 1.0f; }

  const Query& query_;
  int word_count_;
  BoxRay box_rays_[kMaxRayCount];
};

}  // namespace

OcclusionMask trace_scalar(const Layout& layout, const Query& query) {
  ScalarKernel kernel(query);
  return trace(layout, query, kernel);
}

OcclusionMask trace_scalar(const SceneLayout& scene, const Query& query) {
  ScalarKernel kernel(query);
  return trace(scene, query, kernel);
}

}  // namespace lkao::bvh
