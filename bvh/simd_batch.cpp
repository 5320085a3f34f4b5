// Compiled once for every SIMD target (Highway); the fastest that the processor has is chosen at run time.
#include "bvh/simd_batch.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/geometric.hpp>

#include "bvh/bounds.h"
#include "bvh/scalar_kernel.h"
#include "bvh/scene_query.h"
#include "bvh/simd_scene.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bvh/simd_batch.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "lut/isa.h"

#if HWY_TARGET == HWY_SCALAR  // no vectors, nothing to gain

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {
namespace {

void trace_batch(const SceneLayout& scene, std::span<const Query> queries, std::span<OcclusionMask> blocked) {
  for (std::size_t k = 0; k < queries.size(); ++k) blocked[k] = trace_scalar(scene, queries[k]);
}

}  // namespace
}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#else

#include "bvh/simd/batch_rays-inl.h"
#include "bvh/simd/box_masks-inl.h"
#include "bvh/simd/instance_rays-inl.h"
#include "bvh/simd/walkers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {
namespace {

class BatchTraversal {
 public:
  BatchTraversal(const SceneLayout& scene, std::span<const Query> queries) : scene_(scene), batch_(queries) {
    Bounds origins = kNowhere;
    for (const Query& query : queries) origins = merge(origins, {query.rays.origin, query.rays.origin});
    center_ = 0.5f * origins.lower + 0.5f * origins.upper;
  }

  void run(std::span<OcclusionMask> blocked) {
    BatchPart all;
    for (int chunk = 0; chunk < batch_.chunk_count(); ++chunk) all.add(chunk, batch_.open[chunk]);
    for (const Node& root : batch_.query(0).roots) visit(root, all, 0);
    for (int k = 0; k < batch_.receiver_count(); ++k) {
      blocked[static_cast<std::size_t>(k)] = batch_.query(k).open & ~batch_.open_mask(k);
    }
  }

 private:
  // More rays of a receiver than these stay together.
  static constexpr int kFew = 48;

  // What visits need, by how deep the node lies.
  struct Level {
    RelativeBoxes<WholeRays> boxes[kMaxBatchReceivers];  // of receivers that have rays there
    BatchPart met;                                       // by rays of the child that is looked at
  };

  // `active`: rays that may meet the node, some of them perhaps blocked by now. The nearest children come first: what
  // they block spares the others.
  void visit(const Node& node, const BatchPart& active, std::size_t depth) {
    if (depth == levels_.size()) levels_.push_back(std::make_unique<Level>());
    Level& level = *levels_[depth];
    int order[kWidth];
    const int count = order_children(node, set_boxes(level, node, active), order);
    for (int i = 0; i < count; ++i) {
      find_met(level, order[i], active);
      if (level.met.count == 0) continue;
      const ChildRef child = node.children[order[i]];
      if (child.is_leaf()) {
        visit_instance(child.index(), level, order[i]);
      } else {
        visit(scene_.nodes[child.index()], level.met, depth + 1);
      }
    }
  }

  // Returns the children that a receiver may reach.
  HWY_NOINLINE std::uint32_t set_boxes(Level& level, const Node& node, const BatchPart& active) const {
    std::uint32_t reached = 0;
    for (int i = 0, last = -1; i < active.count; ++i) {
      const int receiver = batch_.receiver_of(active.chunks[i]);
      if (receiver == last) continue;
      last = receiver;
      level.boxes[receiver] = RelativeBoxes<WholeRays>(node, batch_.query(receiver));
      reached |= level.boxes[receiver].reached();
    }
    return reached;
  }

  int order_children(const Node& node, std::uint32_t children, int (&order)[kWidth]) const {
    float distances[kWidth];
    int count = 0;
    for (; children != 0; children &= children - 1) {
      const int child = std::countr_zero(children);
      const Bounds box = node.child_bounds(child);
      const glm::vec3 way = 0.5f * box.lower + 0.5f * box.upper - center_;
      distances[child] = glm::dot(way, way);
      int place = count++;
      for (; place > 0 && distances[order[place - 1]] > distances[child]; --place) order[place] = order[place - 1];
      order[place] = child;
    }
    return count;
  }

  // Open rays of `active` that may meet the child.
  HWY_NOINLINE void find_met(Level& level, int child, const BatchPart& active) const {
    level.met.count = 0;
    for (int i = 0; i < active.count; ++i) {
      const int chunk = active.chunks[i];
      const RelativeBoxes<WholeRays>& boxes = level.boxes[batch_.receiver_of(chunk)];
      std::uint32_t mask = static_cast<std::uint32_t>(active.masks[i]) & batch_.open[chunk];
      if (mask == 0 || (boxes.reached() >> child & 1) == 0) continue;
      if ((boxes.holding_origin() >> child & 1) == 0) mask &= boxes.rays_meeting(child, batch_, WholeRays(), chunk);
      level.met.add(chunk, mask);
    }
  }

  // Receiver by receiver: many rays stay together, and the few of several are traced as many.
  void visit_instance(std::uint32_t instance, const Level& level, int child) {
    const BatchPart& met = level.met;
    few_.begin(scene_, instance);
    for (int i = 0; i < met.count;) {
      const int receiver = batch_.receiver_of(met.chunks[i]), first = i;
      int ray_count = 0;
      for (; i < met.count && batch_.receiver_of(met.chunks[i]) == receiver; ++i) {
        ray_count += std::popcount(met.masks[i]);
      }
      const Query& query = batch_.query(receiver);
      if (!may_block(scene_, query, instance)) continue;
      if (ray_count > kFew || !suits_walkers(query, instance)) {
        trace_alone(instance, receiver, met, first, i);
        continue;
      }
      if (!few_.has_room_for(ray_count)) trace_few();
      few_.add_receiver(query, batch_.first_chunk(receiver) * kLaneCount);
      for (int k = first; k < i; ++k) {
        alignas(64) float enter[kLaneCount], leave[kLaneCount];
        level.boxes[receiver].find_range(child, batch_, met.chunks[k], enter, leave);
        few_.add(batch_, met.chunks[k], met.masks[k], enter, leave);
      }
    }
    trace_few();
  }

  bool suits_walkers(const Query& query, std::uint32_t instance) const {
    const bool excludes = query.excluded_instance == instance && query.excluded_primitive != kNoPrimitive;
    const Placement& placement = scene_.placements[instance];
    return placement.suits_floats && !excludes && !has_holes(scene_.mesh_of(placement).options.cut_outs);
  }

  // Chunks from `first` on to before `last`.
  void trace_alone(std::uint32_t instance, int receiver, const BatchPart& met, int first, int last) {
    OcclusionMask open;
    for (int i = first; i < last; ++i) {
      const int chunk = met.chunks[i] - batch_.first_chunk(receiver);
      open.words[chunk / 4] |= std::uint64_t{met.masks[i]} << (chunk % 4 * kLaneCount);
    }
    batch_.close(receiver, trace_instance(scene_, batch_.query(receiver), instance, open));
  }

  void trace_few() {
    if (few_.count() == 0) return;
    if (few_.finish()) {
      walkers_.run(few_);
      for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(few_.count()); ++i) {
        batch_.close(few_.place_of(i), 1 - few_.ray(i).is_open);
      }
    } else {
      for (int i = 0; i < few_.receiver_count(); ++i) {
        const int receiver = static_cast<int>(few_.first_place(i)) / kLaneCount / batch_.chunks_each();
        batch_.close(receiver, trace_instance(scene_, few_.receiver(i), few_.instance(), few_.rays_of(i)));
      }
    }
    few_.clear();
  }

  const SceneLayout& scene_;
  glm::vec3 center_;  // of the receivers
  BatchRays batch_;
  InstanceRays few_;
  Walkers walkers_;
  std::vector<std::unique_ptr<Level> > levels_;
};

void trace_batch(const SceneLayout& scene, std::span<const Query> queries, std::span<OcclusionMask> blocked) {
  // Too large for stacks.
  std::make_unique<BatchTraversal>(scene, queries)->run(blocked);
}

}  // namespace
}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

#if HWY_ONCE
namespace lkao::bvh {

HWY_EXPORT(trace_batch);

void trace_batch(const SceneLayout& scene, std::span<const Query> queries, std::span<OcclusionMask> blocked) {
  LKAO_DISPATCH(trace_batch)(scene, queries, blocked);
}

}  // namespace lkao::bvh
#endif
