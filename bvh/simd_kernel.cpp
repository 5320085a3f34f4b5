// Compiled once for every SIMD target (Highway); the fastest that the processor has is chosen at run time.
//
// Wide phase: nodes are visited with a mask of all rays, tested 16 at a time (a chunk: neighbours in the pattern).
// Stream: children that few rays may meet are put aside, and answered ray by ray once all of them are known.
//
// Differs from the paper, whose masks come from a table (table_kernel.cpp): here from box and plane tests of the rays
// in single precision. They are conservative; a ray within their rounding of a triangle's planes is decided by
// TriangleTest. So every target gives the bits of the scalar kernel, whether it fuses multiply-adds or not.
#include "bvh/simd_kernel.h"

#include <algorithm>
#include <bit>

#include "bvh/scalar_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bvh/simd_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "lut/isa.h"

#if HWY_TARGET == HWY_SCALAR  // no vectors, nothing to gain

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {
namespace {

OcclusionMask trace_simd(const Layout& layout, const Query& query, const PatternCones&) {
  return trace_scalar(layout, query);
}

}  // namespace
}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#else

#include "bvh/simd/box_masks-inl.h"
#include "bvh/simd/bundle_box-inl.h"
#include "bvh/simd/chunk_cones-inl.h"
#include "bvh/simd/direction_cells-inl.h"
#include "bvh/simd/ray_sets-inl.h"
#include "bvh/simd/ray_stream-inl.h"
#include "bvh/simd/wide_leaves-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {
namespace {

// kRemembers: with the query's memory of blockers.
template <class Parts, bool kRemembers>
class SimdTraversal {
 public:
  SimdTraversal(const Layout& layout, const Query& query, const PatternCones& cones)
      : layout_(layout),
        query_(query),
        receiver_(layout, query),
        rays_(query),
        parts_(query),
        cones_(cones, query.rays.frame, rays_.chunk_count, query.near(), query.far()),
        bundle_(cones, query.radius),
        asks_cones_(cones.are_of_use(rays_.chunk_count * kLaneCount)),
        few_(bundle_.is_of_use() ? 4 + rays_.chunk_count / 2
             : asks_cones_       ? 32
                                 : 16),
        // Narrow bundles of few rays have none.
        leaves_(layout, query, cones, receiver_, rays_, parts_,
                bundle_.is_of_use() && !asks_cones_ ? nullptr : &cones_),
        stream_(layout, query, receiver_, rays_) {
    if (asks_cones_) cones_.prepare();
  }

  OcclusionMask run() {
    if constexpr (kRemembers) {
      if (query_.memory->guesses_now()) {
        alignas(64) std::uint32_t cells[kMaxRayCount];
        find_cells(rays_, cells);
        visit_first();
        stream_.guess(cells, query_.memory->leaves());
        traverse();
        remember(cells);
      } else {
        visit_first();
        if (rays_.any_open()) traverse();
      }
    } else {
      traverse();
    }
    const OcclusionMask blocked = query_.open & ~rays_.open_mask();
    if (query_.memory != nullptr && query_.memory->is_observed()) {
      query_.memory->observe({query_.open.count(), blocked.count(), stream_.pair_count(), test_count_});
    }
    return blocked;
  }

 private:
  ActiveRays all_rays() const { return {rays_.open, rays_.chunk_count}; }

  void traverse() {
    for (const Node& root : query_.roots) visit(root, all_rays());
    stream_.run();
  }

  // The leaves that blocked most rays of the receivers before.
  void visit_first() {
    BlockerMemory& memory = *query_.memory;
    RelativeBoxes<Parts> boxes(memory.first(), query_);
    if (bundle_.is_of_use()) boxes.keep(bundle_.met(boxes));
    for (int child = 0; child < memory.first_count(); ++child) {
      int blocked_count = 0;
      if ((boxes.reached() >> child & 1) != 0) {
        ChunkMasks met;
        const ActiveRays rays = rays_meeting(boxes, child, all_rays(), met);
        if (rays.count > 0) blocked_count = leaves_.visit(layout_.leaves[memory.first().children[child].index()], rays);
      }
      memory.score(child, blocked_count);
    }
    memory.drop_below(many_rays() / 2);
  }

  void remember(const std::uint32_t* cells) {
    std::uint32_t* const leaves = query_.memory->leaves();
    for (int ray = 0; ray < query_.rays.ray_count; ++ray) {
      const bool is_open = rays_.is_open(static_cast<std::uint32_t>(ray));
      if (query_.open.test(ray)) leaves[cells[ray]] = is_open ? BlockerMemory::kNone : rays_.blockers[ray];
    }
  }

  // A leaf that blocks so many is worth a place among the first.
  int many_rays() const { return std::max(2, query_.rays.ray_count / 32); }

  // Open rays of `active` that may meet the child.
  HWY_INLINE ActiveRays rays_meeting(const RelativeBoxes<Parts>& boxes, int child, const ActiveRays& active,
                                     ChunkMasks& met) {
    std::uint64_t tested = active.chunks;
    if (asks_cones_) tested &= cones_.meeting(boxes, child);
    test_count_ += std::popcount(tested);
    met.clear(rays_.chunk_count);
    std::uint64_t chunks = 0;
    int count = 0;
    for_each_chunk(tested, [&](int chunk) {
      const std::uint32_t candidates = static_cast<std::uint32_t>(active.masks[chunk]) & rays_.open[chunk];
      const std::uint32_t mask = candidates & boxes.rays_meeting(child, rays_, parts_, chunk);
      met.of[chunk] = static_cast<std::uint16_t>(mask);
      chunks |= static_cast<std::uint64_t>(mask != 0) << chunk;
      count += std::popcount(mask);
    });
    return {met.of, chunks, count};
  }

  // Those of `active` that are still open.
  HWY_INLINE ActiveRays open_rays(const ActiveRays& active, ChunkMasks& masks) const {
    masks.set_to_and(active.masks, rays_.open, rays_.chunk_count);
    return {masks.of, rays_.chunk_count};
  }

  // `active`: rays that may meet the node. Those that were blocked in the meantime are left out here. The last children
  // come first: the builder puts those with the fewest triangles there, among them large ones by themselves, which
  // block most for the least work.
  void visit(const Node& node, const ActiveRays& active) {
    RelativeBoxes<Parts> boxes(node, query_);
    if (bundle_.is_of_use()) boxes.keep(bundle_.met(boxes));
    if (asks_cones_) {
      visit_in_turn(node, boxes, active);
    } else {
      if (bundle_.has_signs()) boxes.sort_faces(bundle_.goes_down());
      visit_tested(node, boxes, active);
    }
  }

  void visit_in_turn(const Node& node, const RelativeBoxes<Parts>& boxes, const ActiveRays& active) {
    for (std::uint32_t children = boxes.reached(); children != 0;) {
      const int child = last_of(children);
      children ^= 1u << child;
      ChunkMasks met;
      const bool holds_origin = (boxes.holding_origin() >> child & 1) != 0;
      const ActiveRays rays = holds_origin ? open_rays(active, met) : rays_meeting(boxes, child, active, met);
      if (rays.count > 0) visit(node.children[child], node, child, rays);
    }
  }

  // All children are tested first.
  void visit_tested(const Node& node, const RelativeBoxes<Parts>& boxes, const ActiveRays& active) {
    ChunkMasks open_masks;
    const ActiveRays open = open_rays(active, open_masks);
    if (open.count == 0) return;
    const std::uint32_t inside = boxes.holding_origin(), outside = boxes.reached() & ~inside;
    ChunkMasks met[kWidth];
    ActiveRays rays[kWidth];
    if (bundle_.has_signs()) {
      test_pairs<true>(boxes, outside, open, met, rays);
    } else if (bundle_.is_of_use()) {
      test_pairs<false>(boxes, outside, open, met, rays);
    } else if (ChunkCones::Node8::kFits && std::popcount(outside) >= 3) {
      test_pairs_by_cones(boxes, outside, open, met, rays);
    } else {
      for (std::uint32_t children = outside; children != 0; children &= children - 1) {
        const int child = std::countr_zero(children);
        rays[child] = rays_meeting(boxes, child, open, met[child]);
      }
    }
    for (std::uint32_t children = boxes.reached(); children != 0;) {
      const int child = last_of(children);
      children ^= 1u << child;
      const ActiveRays& meeting = (inside >> child & 1) != 0 ? open : rays[child];
      if (meeting.count > 0) visit(node.children[child], node, child, meeting);
    }
  }

  // Children `outside` of the origin: all pairs of a child and a chunk in one loop. As nested loops, with a few turns
  // each, the processor would guess wrong at every end.
  template <bool kHasSigns>
  HWY_INLINE void test_pairs(const RelativeBoxes<Parts>& boxes, std::uint32_t outside, const ActiveRays& open,
                             ChunkMasks (&met)[kWidth], ActiveRays (&rays)[kWidth]) {
    for (int child = 0; child < kWidth; ++child) met[child].clear(rays_.chunk_count);
    for (int first = 0; first < rays_.chunk_count; first += 8) {
      std::uint64_t pairs = rows_of(open, first) * outside;
      test_count_ += std::popcount(pairs);
      for (; pairs != 0; pairs &= pairs - 1) {
        const int bit = std::countr_zero(pairs), child = bit & 7, chunk = first + (bit >> 3);
        const std::uint32_t meeting = kHasSigns ? boxes.rays_of_signs_meeting(child, rays_, parts_, chunk)
                                                : boxes.rays_meeting(child, rays_, parts_, chunk);
        met[child].of[chunk] = static_cast<std::uint16_t>(open.masks[chunk] & meeting);
      }
    }
    for (; outside != 0; outside &= outside - 1) {
      const int child = std::countr_zero(outside);
      rays[child] = ActiveRays(met[child].of, rays_.chunk_count);
    }
  }

  // A byte for each of 8 chunks from `first` on, 1 where it has rays.
  static HWY_INLINE std::uint64_t rows_of(const ActiveRays& rays, int first) {
    std::uint64_t rows = 0;
    for (int i = 0; i < 8; ++i) rows |= (rays.chunks >> (first + i) & 1) << (8 * i);
    return rows;
  }

  // Only those pairs of a child and a chunk whose cone meets it.
  HWY_INLINE void test_pairs_by_cones(const RelativeBoxes<Parts>& boxes, std::uint32_t outside, const ActiveRays& open,
                                      ChunkMasks (&met)[kWidth], ActiveRays (&rays)[kWidth]) {
    cones_.prepare();
    const typename ChunkCones::Node8 node(cones_, boxes);
    for (int child = 0; child < kWidth; ++child) {
      met[child].clear(rays_.chunk_count);
      rays[child] = {met[child].of, 0, 0};
    }
    for (int first = 0; first < rays_.chunk_count; first += 8) {
      std::uint64_t pairs = 0;  // a byte of children a chunk
      for (int i = 0; i < 8; ++i) pairs |= static_cast<std::uint64_t>(node.met_by(first + i)) << (8 * i);
      pairs &= rows_of(open, first) * outside;
      test_count_ += std::popcount(pairs);
      for (; pairs != 0; pairs &= pairs - 1) {
        const int bit = std::countr_zero(pairs), child = bit & 7, chunk = first + (bit >> 3);
        const std::uint32_t mask = open.masks[chunk] & boxes.rays_meeting(child, rays_, parts_, chunk);
        met[child].of[chunk] = static_cast<std::uint16_t>(mask);
        rays[child].chunks |= static_cast<std::uint64_t>(mask != 0) << chunk;
        rays[child].count += std::popcount(mask);
      }
    }
  }

  static int last_of(std::uint32_t children) { return 31 - std::countl_zero(children); }

  // A node that few rays meet goes to the stream, and a leaf that few rays of a chunk meet on average.
  void visit(ChildRef child, const Node& parent, int place, const ActiveRays& rays) {
    if (rays.count <= (child.is_leaf() ? std::popcount(rays.chunks) : few_)) {
      stream_.push(child, rays);
    } else if (child.is_leaf()) {
      const int blocked_count = leaves_.visit(layout_.leaves[child.index()], rays);
      if constexpr (kRemembers) {
        if (blocked_count >= many_rays()) query_.memory->offer(child, parent.child_bounds(place), blocked_count);
      }
    } else {
      visit(layout_.nodes[child.index()], rays);
    }
  }

  const Layout& layout_;
  const Query& query_;
  LeafReceiver receiver_;
  RaySet rays_;
  Parts parts_;
  ChunkCones cones_;
  BundleBox bundle_;
  // Many rays: the cones of chunks are asked first, and children are visited one after the other as they are tested,
  // since what the near ones close spares the tests of the others.
  bool asks_cones_;
  int few_;             // rays of a node that go to the stream: not as many where they stay together
  int test_count_ = 0;  // of a chunk and a box
  WideLeaves<Parts, kRemembers> leaves_;
  RayStream<Parts, kRemembers> stream_;
};

// A traversal takes some 80 KiB of stack: two of them, made part of one function, would take twice that.
template <class Parts, bool kRemembers>
HWY_NOINLINE OcclusionMask traverse(const Layout& layout, const Query& query, const PatternCones& cones) {
  return SimdTraversal<Parts, kRemembers>(layout, query, cones).run();
}

template <class Parts>
OcclusionMask trace(const Layout& layout, const Query& query, const PatternCones& cones) {
  // What blocked many rays of a bundle is worth a first look in any case: it may well block all of the next one.
  const bool guesses = query.memory != nullptr && query.memory->should_guess();
  const bool remembers = guesses || (query.memory != nullptr && cones.is_bundle);
  return remembers ? traverse<Parts, true>(layout, query, cones) : traverse<Parts, false>(layout, query, cones);
}

OcclusionMask trace_simd(const Layout& layout, const Query& query, const PatternCones& cones) {
  return query.parts != nullptr ? trace<PartsOfRays>(layout, query, cones) : trace<WholeRays>(layout, query, cones);
}

}  // namespace
}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

#if HWY_ONCE
namespace lkao::bvh {

HWY_EXPORT(trace_simd);

OcclusionMask trace_simd(const Layout& layout, const Query& query, const PatternCones& cones) {
  return LKAO_DISPATCH(trace_simd)(layout, query, cones);
}

}  // namespace lkao::bvh
#endif
