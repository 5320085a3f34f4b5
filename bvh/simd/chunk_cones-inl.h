// Which chunks of rays may meet a box at all. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_CHUNK_CONES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_CHUNK_CONES_INL_H_
#undef LKAO_BVH_SIMD_CHUNK_CONES_INL_H_
#else
#define LKAO_BVH_SIMD_CHUNK_CONES_INL_H_
#endif

#include <algorithm>
#include <cstdint>

#include <hwy/highway.h>
#include <glm/mat3x3.hpp>

#include "bvh/pattern_cones.h"
#include "bvh/simd/box_masks-inl.h"
#include "bvh/simd/lanes-inl.h"
#include "bvh/simd/ray_sets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

// The cones of a pattern as they lie at a receiver. From a cone, each component of its unit vectors is known to lie
// within an interval; a box that lies on one side of the origin along an axis is entered no earlier than its near face
// divided by the largest component, and left no later than its far face divided by the smallest.
class ChunkCones {
 public:
  using Floats = hn::Vec<RayTag>;

  ChunkCones(const PatternCones& cones, const glm::mat3& frame, int chunk_count, float near, float far)
      : cones_(cones), chunk_count_(chunk_count), near_(near / kSlack), far_(far * kSlack), shortest_(far * 0x1p-20f) {
    const RayTag tag;
    for (int i = 0; i < chunk_count; i += lane_count(tag)) {
      const auto x = hn::Load(tag, cones.x + i), y = hn::Load(tag, cones.y + i), z = hn::Load(tag, cones.z + i);
      for (int row = 0; row < 3; ++row) {
        const auto along =
            hn::MulAdd(hn::Set(tag, frame[0][row]), x,
                       hn::MulAdd(hn::Set(tag, frame[1][row]), y, hn::Mul(hn::Set(tag, frame[2][row]), z)));
        hn::Store(along, tag, axis_[row] + i);
      }
    }
  }

  int chunk_count() const { return chunk_count_; }

  // Of as many chunks as a vector holds, from `first` on: a component of the unit vector along the cone, and of its
  // angle the cosine, or less, and the sine, or more.
  HWY_INLINE Floats axis(int component, int first) const { return hn::Load(RayTag(), axis_[component] + first); }
  HWY_INLINE Floats cosine(int first) const { return hn::Load(RayTag(), cones_.cosine + first); }
  HWY_INLINE Floats sine(int first) const { return hn::Load(RayTag(), cones_.sine + first); }

  // To be called before any of the following: most receivers need it, not all.
  HWY_INLINE void prepare() {
    if (is_prepared_) return;
    is_prepared_ = true;
    for (int i = 0; i < chunk_count_; i += lane_count(RayTag())) {
      for (int component = 0; component < 3; ++component) {
        set_interval(component, i, axis(component, i), cosine(i), sine(i));
      }
    }
  }

  // Chunks that may meet a child's box, as bits.
  template <class Boxes>
  HWY_INLINE std::uint64_t meeting(const Boxes& boxes, int child) const {
    const RayTag tag;
    // Where the box begins and ends, up and down the axis: 0 and next to 0 where it does not on that side.
    Floats gap[2][3], far[2][3];
    for (int axis = 0; axis < 3; ++axis) {
      const float lower = boxes.lower(axis, child), upper = boxes.upper(axis, child);
      gap[0][axis] = hn::Set(tag, std::max(lower, 0.0f));
      gap[1][axis] = hn::Set(tag, std::max(-upper, 0.0f));
      far[0][axis] = hn::Set(tag, std::max(upper, shortest_));
      far[1][axis] = hn::Set(tag, std::max(-lower, shortest_));
    }
    std::uint64_t chunks = 0;
    for (int i = 0; i < chunk_count_; i += lane_count(tag)) {
      const auto of = [&](const float* values) HWY_ATTR { return hn::Load(tag, values + i); };
      chunks |= long_bits_of(tag, meets(tag, gap, far, of)) << i;
    }
    return chunks;
  }

  // The other way round: all boxes of a node against one chunk after the other.
  class Node8 {
   public:
    template <class Boxes>
    HWY_INLINE Node8(const ChunkCones& cones, const Boxes& boxes) : cones_(cones) {
      const BoxTag tag;
      const auto zero = hn::Zero(tag), shortest = hn::Set(tag, cones.shortest_);
      for (int axis = 0; axis < 3; ++axis) {
        const auto lower = boxes.lowers(axis, 0), upper = boxes.uppers(axis, 0);
        gap_[0][axis] = hn::Max(lower, zero);
        gap_[1][axis] = hn::Max(hn::Neg(upper), zero);
        far_[0][axis] = hn::Max(upper, shortest);
        far_[1][axis] = hn::Max(hn::Neg(lower), shortest);
      }
    }

    // Children that a chunk may meet, as bits.
    HWY_INLINE std::uint32_t met_by(int chunk) const {
      const BoxTag tag;
      const auto of = [&](const float* values) HWY_ATTR { return hn::Set(tag, values[chunk]); };
      return bits_of(tag, cones_.meets(tag, gap_, far_, of));
    }

    // A vector holds all children of a node.
    static constexpr bool kFits = hn::MaxLanes(BoxTag()) == kWidth;

   private:
    const ChunkCones& cones_;
    hn::Vec<BoxTag> gap_[2][3], far_[2][3];
  };

 private:
  // `of(intervals)`: those of the chunks in question.
  template <class Tag, class Of>
  HWY_INLINE hn::Mask<Tag> meets(Tag tag, const hn::Vec<Tag> (&gap)[2][3], const hn::Vec<Tag> (&far)[2][3],
                                 const Of& of) const {
    auto enter = hn::Set(tag, near_), leave = hn::Set(tag, far_);
    for (int direction = 0; direction < 2; ++direction) {
      for (int axis = 0; axis < 3; ++axis) {
        enter = hn::Max(enter, hn::Mul(gap[direction][axis], of(soonest_[direction][axis])));
        leave = hn::Min(leave, hn::Mul(far[direction][axis], of(latest_[direction][axis])));
      }
    }
    return hn::Le(enter, leave);
  }

  // `along`: component of the cones' axes.
  HWY_INLINE void set_interval(int axis, int first, Floats along, Floats cosine, Floats sine) {
    const RayTag tag;
    const auto one = hn::Set(tag, 1.0f), rounding = hn::Set(tag, 2e-6f);
    // sin of the angle to the axis; the square's rounding error counts most where it is small.
    const auto across = hn::Sqrt(hn::Max(hn::NegMulAdd(along, along, hn::Set(tag, 1.0f + 1e-6f)), hn::Zero(tag)));
    const auto middle = hn::Mul(along, cosine), spread = hn::MulAdd(across, sine, rounding);
    // A cone that holds the axis reaches 1.
    const auto limit = hn::Sub(cosine, rounding);
    const auto largest = hn::IfThenElse(hn::Ge(along, limit), one, hn::Add(middle, spread));
    const auto smallest = hn::IfThenElse(hn::Ge(hn::Neg(along), limit), hn::Neg(one), hn::Sub(middle, spread));
    hn::Store(limited_reciprocal(largest), tag, soonest_[0][axis] + first);
    hn::Store(limited_reciprocal(hn::Neg(smallest)), tag, soonest_[1][axis] + first);
    const auto slack = hn::Set(tag, kSlack);
    hn::Store(hn::Mul(limited_reciprocal(smallest), slack), tag, latest_[0][axis] + first);
    hn::Store(hn::Mul(limited_reciprocal(hn::Neg(largest)), slack), tag, latest_[1][axis] + first);
  }

  // 1 / v; large where v is not positive: no ray of the chunk goes that way, or not all of them.
  static HWY_INLINE Floats limited_reciprocal(Floats v) {
    const RayTag tag;
    const auto limited = hn::Max(v, hn::Set(tag, 0x1p-40f));
    return reciprocal(tag, limited);
  }

  static constexpr float kSlack = 1.0f + 0x1p-16f;  // of lengths and reciprocals

  const PatternCones& cones_;
  int chunk_count_;
  float near_, far_;  // between these distances boxes count
  float shortest_;
  bool is_prepared_ = false;
  alignas(64) float axis_[3][kMaxChunkCount];  // by component and chunk
  // By direction (up or down the axis), axis and chunk: 1 / component.
  alignas(64) float soonest_[2][3][kMaxChunkCount];
  alignas(64) float latest_[2][3][kMaxChunkCount];
};

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
