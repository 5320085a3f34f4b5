// Single rays of several receivers through the hierarchy of a mesh. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_WALKERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_WALKERS_INL_H_
#undef LKAO_BVH_SIMD_WALKERS_INL_H_
#else
#define LKAO_BVH_SIMD_WALKERS_INL_H_
#endif

#include <cstddef>
#include <cstdint>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "bvh/layout.h"
#include "bvh/simd/box_masks-inl.h"
#include "bvh/simd/instance_rays-inl.h"
#include "bvh/simd/leaf_frames-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

// Each ray goes its own way, one node or leaf at a time, until it is blocked or has seen all that it may meet; while
// one takes its step, what the next ones will look at is on its way into the cache.
//
// Differs from RayStream, which answers all pairs of a ray and a node as they come: there half of the leaves are of
// rays that another leaf closes at the same time. Where most of what a ray meets blocks it, as in trees, that is half
// of the work; where little does, finding each ray's next step costs more than it spares.
class Walkers {
 public:
  // Closes the rays that some triangle of the mesh blocks.
  HWY_NOINLINE void run(InstanceRays& rays) {
    rays_ = &rays;
    layout_ = &rays.mesh();
    next_ray_ = 0;
    const Query query = rays.query();
    LeafReceiver receiver(*layout_, query);
    receiver.displacement = rays.displacement();
    Group groups[2];
    for (std::uint32_t i = 0; i < kWalkerCount; ++i) {
      walkers_[i].depth = 0;
      groups[i / kGroup].walkers[i % kGroup] = i;
    }
    int turn = 0;
    take(groups[0]);
    while (groups[0].count + groups[1].count > 0) {
      take(groups[1 - turn]);
      step(receiver, groups[turn]);
      turn = 1 - turn;
    }
  }

 private:
  static constexpr int kGroup = 16, kWalkerCount = 2 * kGroup;
  // Each level of the hierarchy adds at most 7 children, and a whole vector is stored.
  static constexpr int kStackSize = kWidth * kMaxDepth + kWidth;

  struct Walker {
    std::uint32_t ray;
    int depth;                           // of the stack
    std::uint32_t children[kStackSize];  // that the ray may meet, as ChildRef::bits
  };

  // Walkers that take their steps together, and what they will look at.
  struct Group {
    int count = kGroup;
    std::uint32_t walkers[kGroup];
    int node_count = 0, leaf_count = 0;
    std::uint32_t nodes[kGroup], node_walkers[kGroup];
    std::uint32_t leaves[kGroup + kLeavesAtOnce], leaf_rays[kGroup + kLeavesAtOnce];
  };

  // Finds the next step of each walker. Those that have none, and no other ray to turn to, leave the group.
  HWY_INLINE void take(Group& group) {
    int node_count = 0, leaf_count = 0;
    for (int i = 0; i < group.count;) {
      const std::uint32_t number = group.walkers[i];
      Walker& walker = walkers_[number];
      std::uint32_t child = 0;  // the root
      if (walker.depth > 0 && rays_->ray(walker.ray).is_open != 0) {
        child = walker.children[--walker.depth];
      } else if (next_ray_ < rays_->count()) {
        walker.depth = 0;
        walker.ray = static_cast<std::uint32_t>(next_ray_++);
      } else {
        group.walkers[i] = group.walkers[--group.count];
        continue;
      }
      ++i;
      const std::uint32_t is_leaf = child >> 31, index = child & ~ChildRef::kLeafBit;
      prefetch(is_leaf, index);
      group.nodes[node_count] = index;
      group.node_walkers[node_count] = number;
      node_count += static_cast<int>(1 - is_leaf);
      group.leaves[leaf_count] = index;
      group.leaf_rays[leaf_count] = walker.ray;
      leaf_count += static_cast<int>(is_leaf);
    }
    group.node_count = node_count;
    group.leaf_count = leaf_count;
  }

  HWY_INLINE void prefetch(std::uint32_t is_leaf, std::uint32_t index) const {
    // Without a branch, which would be guessed wrong half of the time.
    const void* const items[] = {layout_->nodes.data(), layout_->leaves.data()};
    constexpr std::size_t kSizes[] = {sizeof(Node), sizeof(Leaf)};
    const std::uint8_t* const item = static_cast<const std::uint8_t*>(items[is_leaf]) + index * kSizes[is_leaf];
    for (int offset = 0; offset < 256; offset += 64) hwy::Prefetch(item + offset);
  }

  HWY_INLINE void step(const LeafReceiver& receiver, Group& group) {
    for (int i = 0; i < group.node_count; ++i) {
      visit(layout_->nodes[group.nodes[i]], walkers_[group.node_walkers[i]]);
    }
    if (group.leaf_count == 0) return;
    // The last pair again, until the last vector is full.
    for (int i = group.leaf_count; i < group.leaf_count + kLeavesAtOnce - 1; ++i) {
      group.leaves[i] = group.leaves[group.leaf_count - 1];
      group.leaf_rays[i] = group.leaf_rays[group.leaf_count - 1];
    }
    for (int i = 0; i < group.leaf_count; i += kLeavesAtOnce) {
      visit_leaves(receiver, group.leaves + i, group.leaf_rays + i);
    }
  }

  HWY_INLINE void visit(const Node& node, Walker& walker) {
    const BoxTag tag;
    const hn::RebindToUnsigned<BoxTag> bits_tag;
    const InstanceRays::Ray& ray = rays_->ray(walker.ray);
    int depth = walker.depth;
    for (int i = 0; i < kWidth; i += lane_count(tag)) {
      const auto face_origin = [&](std::uint32_t face, int axis) { return ray.face_origins[face][axis]; };
      const auto met = children_met(node, i, ray.inverse, face_origin, hn::Zero(tag), hn::Set(tag, 1.0f));
      const auto children = hn::Load(bits_tag, node.child_bits() + i);
      depth += store_packed(bits_tag, children, hn::RebindMask(bits_tag, met), walker.children + depth);
    }
    walker.depth = depth;
  }

  HWY_INLINE void visit_leaves(const LeafReceiver& receiver, const std::uint32_t* leaf_numbers,
                               const std::uint32_t* ray_numbers) {
    constexpr std::uint32_t kOneLeaf = (1u << kLeafWidth) - 1;
    const Leaf* leaves[kLeavesAtOnce];
    InstanceRays::Ray* rays[kLeavesAtOnce];
    const float *origins[kLeavesAtOnce], *towards[kLeavesAtOnce];
    for (int i = 0; i < kLeavesAtOnce; ++i) {
      leaves[i] = layout_->leaves.data() + leaf_numbers[i];
      rays[i] = &rays_->ray(ray_numbers[i]);
      origins[i] = rays[i]->origin;
      towards[i] = rays[i]->towards;
    }
    const LeafFrames<kLeavesAtOnce> frames(receiver, leaves, origins);
    const Verdict triangles = frames.blocked(towards);
    // What blocked() says where a side is not sure may be wrong.
    const std::uint32_t sure = triangles.sure & ~frames.unsure_sides();
    const std::uint32_t in_doubt = (triangles.perhaps | frames.unsure_sides()) & ~sure;
    for (int i = 0; i < kLeavesAtOnce; ++i) {
      std::uint32_t blocked = (sure >> (i * kLeafWidth) & kOneLeaf) != 0;
      const std::uint32_t doubts = in_doubt >> (i * kLeafWidth) & kOneLeaf;
      if (HWY_UNLIKELY(doubts != 0) && blocked == 0) blocked = rays_->is_blocked(*leaves[i], doubts, ray_numbers[i]);
      rays[i]->is_open &= ~blocked;
    }
  }

  InstanceRays* rays_;
  const Layout* layout_;
  int next_ray_;
  Walker walkers_[kWalkerCount];
};

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
