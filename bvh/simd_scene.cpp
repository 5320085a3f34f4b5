// Compiled once for every SIMD target (Highway); the fastest that the processor has is chosen at run time.
#include "bvh/simd_scene.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "bvh/place_rays.h"
#include "bvh/scalar_kernel.h"
#include "bvh/scene_query.h"
#include "bvh/simd_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bvh/simd_scene.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "lut/isa.h"

#if HWY_TARGET == HWY_SCALAR  // no vectors, nothing to gain

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {
namespace {

OcclusionMask trace_simd(const SceneLayout& scene, const Query& query) { return trace_scalar(scene, query); }

float turn_open_rays(const Query& world, float, ReceiverRays& to) {
  const glm::dmat3 turn(world.placement->to_mesh);
  float longest2 = 0;
  int count = 0;
  for_each_ray(world.open, world.rays.word_count(), [&](int number) {
    const glm::vec3 ray(turn * glm::dvec3(world.rays.ray(number)));
    to.x[count] = ray.x;
    to.y[count] = ray.y;
    to.z[count++] = ray.z;
    longest2 = std::max(longest2, glm::dot(ray, ray));
  });
  return std::sqrt(longest2);
}

}  // namespace
}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#else

#include "bvh/simd/box_masks-inl.h"
#include "bvh/simd/ray_sets-inl.h"
#include "bvh/simd/turned_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {
namespace {

template <class Parts>
class SceneTraversal {
 public:
  SceneTraversal(const SceneLayout& scene, const Query& query)
      : scene_(scene), query_(query), rays_(query), parts_(query) {}

  OcclusionMask run() {
    for (const Node& root : query_.roots) visit(root, {rays_.open, rays_.chunk_count});
    return query_.open & ~rays_.open_mask();
  }

 private:
  // `active`: rays that may meet the node, some of them perhaps blocked by now. The nearest children come first: what
  // they block spares the others, each of which costs the rays a way to another space.
  void visit(const Node& node, const ActiveRays& active) {
    const RelativeBoxes<Parts> boxes(node, query_);
    int order[kWidth];
    const int count = order_children(boxes, order);
    for (int i = 0; i < count; ++i) {
      const int child = order[i];
      ChunkMasks met;
      const ActiveRays rays = rays_meeting(boxes, child, active, met);
      if (rays.count == 0) continue;
      const ChildRef ref = node.children[child];
      if (ref.is_leaf()) {
        visit_instance(ref.index(), rays);
      } else {
        visit(scene_.nodes[ref.index()], rays);
      }
    }
  }

  static int order_children(const RelativeBoxes<Parts>& boxes, int (&order)[kWidth]) {
    float distances[kWidth];
    int count = 0;
    for (std::uint32_t children = boxes.reached(); children != 0; children &= children - 1) {
      const int child = std::countr_zero(children);
      distances[child] = boxes.center_distance2(child);
      int place = count++;
      for (; place > 0 && distances[order[place - 1]] > distances[child]; --place) order[place] = order[place - 1];
      order[place] = child;
    }
    return count;
  }

  // Open rays of `active` that may meet the child.
  HWY_INLINE ActiveRays rays_meeting(const RelativeBoxes<Parts>& boxes, int child, const ActiveRays& active,
                                     ChunkMasks& met) const {
    const bool holds_origin = (boxes.holding_origin() >> child & 1) != 0;
    met.clear(rays_.chunk_count);
    std::uint64_t chunks = 0;
    int count = 0;
    for_each_chunk(active.chunks, [&](int chunk) {
      std::uint32_t mask = static_cast<std::uint32_t>(active.masks[chunk]) & rays_.open[chunk];
      if (!holds_origin && mask != 0) mask &= boxes.rays_meeting(child, rays_, parts_, chunk);
      met.of[chunk] = static_cast<std::uint16_t>(mask);
      chunks |= static_cast<std::uint64_t>(mask != 0) << chunk;
      count += std::popcount(mask);
    });
    return {met.of, chunks, count};
  }

  void visit_instance(std::uint32_t instance, const ActiveRays& rays) {
    if (!may_block(scene_, query_, instance)) return;
    OcclusionMask open;
    std::memcpy(open.words, rays.masks, sizeof(std::uint16_t) * static_cast<std::size_t>(rays_.chunk_count));
    const OcclusionMask closed = trace_instance(scene_, query_, instance, open);
    for (int chunk = 0; chunk < rays_.chunk_count; ++chunk) {
      rays_.open[chunk] &= static_cast<std::uint16_t>(~(closed.words[chunk / 4] >> (chunk % 4 * kLaneCount)));
    }
  }

  const SceneLayout& scene_;
  const Query& query_;
  RaySet rays_;
  Parts parts_;
};

template <class Parts>
HWY_NOINLINE OcclusionMask traverse(const SceneLayout& scene, const Query& query) {
  return SceneTraversal<Parts>(scene, query).run();
}

// Rays of a chunk in the space of the query's instance, no longer than `reach`.
HWY_INLINE void turn_chunk(const Query& world, int chunk, float reach, float (&turned)[3][kLaneCount]) {
  const TurnedRays::DoubleTag double_tag;
  const TurnedRays::FloatTag tag;
  const int first = chunk * kLaneCount;
  for (int i = 0; i < kLaneCount; i += lane_count(tag)) {
    const ReceiverRays& from = world.rays;
    const TurnedRays rays(world.placement->to_mesh, from.x + first + i, from.y + first + i, from.z + first + i);
    const auto share = hn::PromoteTo(double_tag, hn::Min(rays.share_of(reach), hn::Set(tag, 1.0f)));
    hn::Store(hn::DemoteTo(tag, hn::Mul(share, rays.x())), tag, turned[0] + i);
    hn::Store(hn::DemoteTo(tag, hn::Mul(share, rays.y())), tag, turned[1] + i);
    hn::Store(hn::DemoteTo(tag, hn::Mul(share, rays.z())), tag, turned[2] + i);
  }
}

float turn_open_rays(const Query& world, float reach, ReceiverRays& to) {
  const RayTag tag;
  const hn::RebindToUnsigned<RayTag> bits_tag;
  float* const components[] = {to.x, to.y, to.z};
  auto longest2 = hn::Zero(tag);
  int count = 0;
  for (int chunk = 0; chunk * kLaneCount < world.rays.ray_count; ++chunk) {
    const std::uint64_t mask = world.open.words[chunk / 4] >> (chunk % 4 * kLaneCount);
    if ((mask & ((1u << kLaneCount) - 1)) == 0) continue;
    alignas(64) float turned[3][kLaneCount];
    turn_chunk(world, chunk, reach, turned);
    for (int i = 0; i < kLaneCount; i += lane_count(tag)) {
      const auto lanes = static_cast<std::uint32_t>(mask >> i) & ((1u << lane_count(tag)) - 1);
      auto length2 = hn::Zero(tag);
      for (int axis = 0; axis < 3; ++axis) {
        const auto component = hn::Load(tag, turned[axis] + i);
        length2 = hn::MulAdd(component, component, length2);
        // What is stored behind is no farther than the chunk itself.
        store_packed(bits_tag, hn::BitCast(bits_tag, component), lanes,
                     reinterpret_cast<std::uint32_t*>(components[axis] + count));
      }
      longest2 = hn::Max(longest2, hn::IfThenElseZero(mask_of(tag, lanes), length2));
      count += std::popcount(lanes);
    }
  }
  return std::sqrt(hn::GetLane(hn::MaxOfLanes(tag, longest2)));
}

OcclusionMask trace_simd(const SceneLayout& scene, const Query& query) {
  return query.parts != nullptr ? traverse<PartsOfRays>(scene, query) : traverse<WholeRays>(scene, query);
}

}  // namespace
}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

#if HWY_ONCE
namespace lkao::bvh {

HWY_EXPORT(trace_simd);
HWY_EXPORT(turn_open_rays);

OcclusionMask trace_instance(const SceneLayout& scene, const Query& scene_query, std::uint32_t instance,
                             const OcclusionMask& open) {
  const Query query = query_of_instance(scene, scene_query, instance, open);
  const Layout& mesh = scene.mesh_of(scene.placements[instance]);
  PlacedRays placed(query);
  // Where the transform takes them out of the range of floats, the definition is asked at once.
  if (!place_rays(placed, mesh.bounds)) return trace_scalar(mesh, query);
  return in_world(placed, trace_simd(mesh, query_of(placed), cones_of_any_rays()));
}

OcclusionMask trace_simd(const SceneLayout& scene, const Query& query) {
  return LKAO_DISPATCH(trace_simd)(scene, query);
}

float turn_open_rays(const Query& world, float reach, ReceiverRays& to) {
  return LKAO_DISPATCH(turn_open_rays)(world, reach, to);
}

}  // namespace lkao::bvh
#endif
