#include "query/bundle_tracer.h"

#include <utility>

#include "bvh/query.h"
#include "bvh/scalar_kernel.h"
#include "bvh/scene_query.h"
#include "bvh/simd_kernel.h"
#include "bvh/simd_scene.h"

namespace lkao::query {

BundleTracer::BundleTracer(OccluderScene occluders, Sidedness sidedness, Kernel kernel)
    : occluders_(std::move(occluders)), sidedness_(sidedness), kernel_(kernel), memories_(1) {}

BundleTracer::Visit::Visit(const BundleTracer& tracer) : tracer_(tracer) {
  if (tracer.kernel_ == Kernel::simd) memories_.emplace(tracer.memories_);
}

BundleTracer::Visit::Visit(const BundleTracer& tracer, const Bounds& origins, const Bounds& ends) : Visit(tracer) {
  const bool has_origins = origins.lower.x <= origins.upper.x;
  if (has_origins) entries_.emplace(tracer.occluders_.layout().tree(), bvh::Shaft(origins, ends));
}

OcclusionMask BundleTracer::Visit::trace(const Receiver& receiver, std::uint64_t key, ReceiverRays& rays) {
  OcclusionMask blocked, left = rays.cast;
  // One turn for most bundles: rays whose lengths are far apart are traced by length.
  while (left.any()) {
    bvh::make_bundle_shape(rays, left, shape_);
    if (!shape_.rays.any()) break;
    left = left & ~shape_.rays;
    rays.frame = shape_.frame;
    rays.up = shape_.up;
    rays.radius = shape_.radius;
    blocked = blocked | trace_shape(receiver, key, rays);
  }
  return blocked;
}

OcclusionMask BundleTracer::Visit::trace_shape(const Receiver& receiver, std::uint64_t key, const ReceiverRays& rays) {
  const bvh::SceneLayout& scene = tracer_.occluders_.layout();
  const bvh::Layout* const mesh = scene.plain();
  const bool is_simd = tracer_.kernel_ == Kernel::simd;
  bvh::Query query{.roots = scene.roots(),
                   .rays = rays,
                   .open = shape_.rays,
                   .radius = rays.radius,
                   .sidedness = tracer_.sidedness_,
                   .excluded_primitive = receiver.excluded_primitive,
                   .excluded_instance = receiver.excluded_instance,
                   .groups = receiver.occluder_groups,
                   .key = key};
  if (entries_) query.roots = entries_->nodes();
  if (mesh == nullptr) return is_simd ? bvh::trace_simd(scene, query) : bvh::trace_scalar(scene, query);
  if (!bvh::ask_mesh(scene, query)) return {};
  if (memories_) query.memory = &(*memories_)[0];
  return is_simd ? bvh::trace_simd(*mesh, query, shape_.cones) : bvh::trace_scalar(*mesh, query);
}

}  // namespace lkao::query
