// The rays of several receivers. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_BATCH_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_BATCH_RAYS_INL_H_
#undef LKAO_BVH_SIMD_BATCH_RAYS_INL_H_
#else
#define LKAO_BVH_SIMD_BATCH_RAYS_INL_H_
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include <hwy/highway.h>

#include "bvh/query.h"
#include "bvh/simd/lanes-inl.h"
#include "bvh/simd/ray_sets-inl.h"
#include "bvh/simd_batch.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

// One receiver's rays behind the other's, in world space, each filling up its last chunk; and those that are open.
class BatchRays {
 public:
  static constexpr int kMaxChunkCount = kMaxBatchRays / kLaneCount;

  explicit BatchRays(std::span<const Query> queries)
      : queries_(queries), chunks_each_((queries[0].rays.ray_count + kLaneCount - 1) / kLaneCount) {
    for (int k = 0; k < receiver_count(); ++k) {
      const ReceiverRays& rays = query(k).rays;
      const int chunk = first_chunk(k), first = chunk * kLaneCount, count = chunks_each_ * kLaneCount;
      std::fill_n(receiver_of_ + chunk, chunks_each_, static_cast<std::uint8_t>(k));
      std::memcpy(open + chunk, query(k).open.words, sizeof(open[0]) * static_cast<std::size_t>(chunks_each_));
      const float* const from[] = {rays.x, rays.y, rays.z};
      float* const to[] = {x, y, z};
      float* const inverse[] = {inverse_x, inverse_y, inverse_z};
      for (int axis = 0; axis < 3; ++axis) {
        std::copy_n(from[axis], count, to[axis] + first);
        RaySet::invert(from[axis], count, inverse[axis] + first);
      }
    }
  }

  int receiver_count() const { return static_cast<int>(queries_.size()); }
  const Query& query(int receiver) const { return queries_[static_cast<std::size_t>(receiver)]; }
  // Its chunks are neighbours, as many for each receiver.
  int first_chunk(int receiver) const { return receiver * chunks_each_; }
  int chunks_each() const { return chunks_each_; }
  int chunk_count() const { return receiver_count() * chunks_each_; }
  int receiver_of(int chunk) const { return receiver_of_[chunk]; }

  OcclusionMask open_mask(int receiver) const {
    OcclusionMask mask;
    std::memcpy(mask.words, open + first_chunk(receiver), sizeof(open[0]) * static_cast<std::size_t>(chunks_each_));
    return mask;
  }
  void close(int receiver, const OcclusionMask& blocked) {
    for (int chunk = 0; chunk < chunks_each_; ++chunk) {
      const std::uint64_t closed = blocked.words[chunk / 4] >> (chunk % 4 * kLaneCount);
      open[first_chunk(receiver) + chunk] &= static_cast<std::uint16_t>(~closed);
    }
  }
  // A ray by its place in the batch. Without a branch: nothing where `blocked` is 0 instead of 1.
  void close(std::uint32_t ray, std::uint32_t blocked) {
    open[ray / kLaneCount] &= static_cast<std::uint16_t>(~(blocked << (ray % kLaneCount)));
  }

 private:
  std::span<const Query> queries_;
  int chunks_each_;
  std::uint8_t receiver_of_[kMaxChunkCount];

 public:
  std::uint16_t open[kMaxChunkCount];
  alignas(64) float x[kMaxBatchRays], y[kMaxBatchRays], z[kMaxBatchRays];
  alignas(64) float inverse_x[kMaxBatchRays], inverse_y[kMaxBatchRays], inverse_z[kMaxBatchRays];
};
static_assert(kMaxBatchReceivers <= 256);

// Some of them: masks of the chunks that have any, in order.
struct BatchPart {
  int count = 0;
  std::uint16_t chunks[BatchRays::kMaxChunkCount + 1], masks[BatchRays::kMaxChunkCount + 1];

  // Without a branch: nothing where the mask is 0.
  HWY_INLINE void add(int chunk, std::uint32_t mask) {
    chunks[count] = static_cast<std::uint16_t>(chunk);
    masks[count] = static_cast<std::uint16_t>(mask);
    count += mask != 0;
  }
};

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
