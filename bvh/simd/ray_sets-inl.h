// The rays of a receiver as vectors see them, and which of them take part. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_RAY_SETS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_RAY_SETS_INL_H_
#undef LKAO_BVH_SIMD_RAY_SETS_INL_H_
#else
#define LKAO_BVH_SIMD_RAY_SETS_INL_H_
#endif

#include <bit>
#include <cstdint>
#include <cstring>

#include <hwy/highway.h>

#include "bvh/simd/lanes-inl.h"
#include "bvh/traversal.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

inline constexpr int kMaxChunkCount = kMaxRayCount / kLaneCount;

// The rays of a receiver, component by component, and those that are open: not yet blocked.
class RaySet {
 public:
  explicit RaySet(const Query& query)
      : x(query.rays.x), y(query.rays.y), z(query.rays.z), chunk_count(query.rays.ray_count / kLaneCount) {
    const ReceiverRays& rays = query.rays;
    std::memcpy(open, query.open.words, sizeof(open));
    invert(rays.x, rays.ray_count, inverse_x);
    invert(rays.y, rays.ray_count, inverse_y);
    invert(rays.z, rays.ray_count, inverse_z);
  }

  OcclusionMask open_mask() const {
    OcclusionMask mask;
    std::memcpy(mask.words, open, sizeof(open));
    return mask;
  }
  bool is_open(std::uint32_t ray) const { return (open[ray / kLaneCount] >> (ray % kLaneCount) & 1) != 0; }
  // Without a branch: nothing where `blocked` is 0 instead of 1.
  void close(std::uint32_t ray, std::uint32_t blocked) {
    open[ray / kLaneCount] &= static_cast<std::uint16_t>(~(blocked << (ray % kLaneCount)));
  }

  const float *x, *y, *z;
  alignas(64) float inverse_x[kMaxRayCount];
  alignas(64) float inverse_y[kMaxRayCount];
  alignas(64) float inverse_z[kMaxRayCount];
  int chunk_count;
  alignas(64) std::uint16_t open[kMaxChunkCount];

 private:
  // Components shorter than half the margin of boxes count as that long, so that no product with a face overflows:
  // along such a component the ray leaves the box no later than it did.
  static void invert(const float* from, int count, float* to) {
    const RayTag tag;
    const auto shortest = hn::Set(tag, 0.5f * Node::kMargin);
    for (int i = 0; i < count; i += lane_count(tag)) {
      const auto component = hn::Load(tag, from + i);
      const auto limited = hn::CopySign(hn::Max(hn::Abs(component), shortest), component);
      hn::Store(reciprocal(tag, limited), tag, to + i);
    }
  }
};
static_assert(kMaxChunkCount <= 64);
static_assert(std::endian::native == std::endian::little, "a chunk is 16 bits of a 64-bit word");

// Some rays: the chunks that have any, and their masks by chunk number.
struct ActiveRays {
  std::uint64_t chunks;
  const std::uint16_t* masks;  // where `chunks` has no bit there may be anything
};

// Calls `function(chunk)` for every bit.
template <typename Function>
HWY_INLINE void for_each_chunk(std::uint64_t chunks, const Function& function) {
  for (; chunks != 0; chunks &= chunks - 1) function(std::countr_zero(chunks));
}

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
