// Which rays take part: sets of them side by side, and masks of those that are active. Included once for each SIMD
// target.
#if defined(LKAO_BVH_SIMD_RAY_SETS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_RAY_SETS_INL_H_
#undef LKAO_BVH_SIMD_RAY_SETS_INL_H_
#else
#define LKAO_BVH_SIMD_RAY_SETS_INL_H_
#endif

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include <hwy/highway.h>

#include "bvh/simd/lanes-inl.h"
#include "lkao/ambient_occlusion.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

inline constexpr int kMaxChunkCount = kMaxRayCount / kLaneCount;

// Rays in chunks of 16, component by component.
struct RaySet {
  const float *x, *y, *z;
  const float *inverse_x, *inverse_y, *inverse_z;
  const std::uint32_t* numbers;  // of the rays among all rays of the receiver
  std::uint16_t* open;           // by chunk: rays that are not yet blocked

  RaySet from(int chunk) const {
    const int first = chunk * kLaneCount;
    return {x + first,         y + first,         z + first,       inverse_x + first,
            inverse_y + first, inverse_z + first, numbers + first, open + chunk};
  }
};

// Loops over chunks take this many at a time: whole numbers of them are easier to foresee for the processor.
inline constexpr int kChunkStep = 4;

// Some rays of a set, by the chunks that have any.
struct ActiveChunks {
  ActiveChunks() = default;
  explicit ActiveChunks(const RaySet& set, int chunk_count) {
    for (int chunk = 0; chunk < chunk_count; ++chunk) add(chunk, set.open[chunk]);
    finish();
  }
  // Those that are open of the rays in `some_masks`, which go with the chunks of `some`.
  ActiveChunks(const RaySet& set, const ActiveChunks& some, const std::uint16_t* some_masks) {
    for (int i = 0; i < some.count; ++i) {
      add(some.chunks[i], static_cast<std::uint32_t>(some_masks[i]) & set.open[some.chunks[i]]);
    }
    finish();
  }

  int padded_count() const { return (count + kChunkStep - 1) / kChunkStep * kChunkStep; }

  int count = 0;
  std::uint8_t chunks[kMaxChunkCount + kChunkStep];
  alignas(8) std::uint16_t masks[kMaxChunkCount + kChunkStep];  // beyond `count`, up to a step: empty

 private:
  // Without branches: what is not there is overwritten by the next.
  HWY_INLINE void add(int chunk, std::uint32_t mask) {
    chunks[count] = static_cast<std::uint8_t>(chunk);
    masks[count] = static_cast<std::uint16_t>(mask);
    count += mask != 0;
  }
  HWY_INLINE void finish() {
    for (int i = 0; i < kChunkStep; ++i) chunks[count + i] = 0, masks[count + i] = 0;
  }
};

// Rays in the masks of chunks, of which there are a multiple of kChunkStep.
HWY_INLINE int count_rays(const std::uint16_t* masks, int padded_count) {
  int ray_count = 0;
  for (int i = 0; i < padded_count; i += kChunkStep) {
    std::uint64_t step;
    static_assert(sizeof(step) == kChunkStep * sizeof(*masks));
    std::memcpy(&step, masks + i, sizeof(step));
    ray_count += std::popcount(step);
  }
  return ray_count;
}

// Stores those of 16 lanes that the mask has, one after the other; may overwrite the 15 places behind them.
template <typename Lane>
HWY_INLINE void compress(const Lane* from, std::uint32_t mask, Lane* to) {
  const hn::CappedTag<Lane, kLaneCount> tag;
  for (int i = 0; i < kLaneCount; i += lane_count(tag)) {
    const std::uint32_t lanes = mask & ((1u << lane_count(tag)) - 1);
    hn::StoreU(hn::Compress(hn::LoadU(tag, from + i), mask_of(tag, lanes)), tag, to);
    to += std::popcount(lanes);
    mask >>= lane_count(tag);
  }
}

// The rays of one receiver, and room for sets of some of them packed densely.
class RayPool {
 public:
  explicit RayPool(const ReceiverRays& rays) {
    std::memcpy(open_, rays.cast.words, sizeof(open_));
    invert(rays.x, rays.ray_count, inverse_x_);
    invert(rays.y, rays.ray_count, inverse_y_);
    invert(rays.z, rays.ray_count, inverse_z_);
    for (int i = 0; i < rays.ray_count; ++i) numbers_[i] = static_cast<std::uint32_t>(i);
    all_ = {rays.x, rays.y, rays.z, inverse_x_, inverse_y_, inverse_z_, numbers_, open_};
  }
  RayPool(const RayPool&) = delete;
  RayPool& operator=(const RayPool&) = delete;

  const RaySet& all() const { return all_; }

  // Rays not yet blocked.
  OcclusionMask open_mask() const {
    OcclusionMask mask;
    std::memcpy(mask.words, open_, sizeof(open_));
    return mask;
  }
  bool is_open(std::uint32_t ray) const { return (open_[ray / kLaneCount] >> (ray % kLaneCount) & 1) != 0; }

  void close(std::uint32_t ray) {
    open_[ray / kLaneCount] &= static_cast<std::uint16_t>(~(1u << (ray % kLaneCount)));
  }
  // Packs the active rays, `ray_count` of them, which fill at most half as many chunks. The set lasts until unpack(),
  // last packed first unpacked.
  RaySet pack(const RaySet& set, const ActiveChunks& active, int ray_count) {
    const int first = used_;
    for (int i = 0; i < active.count; ++i) {
      const RaySet from = set.from(active.chunks[i]);
      const std::uint32_t mask = active.masks[i];
      compress(from.x, mask, packed_[0] + used_);
      compress(from.y, mask, packed_[1] + used_);
      compress(from.z, mask, packed_[2] + used_);
      compress(from.inverse_x, mask, packed_[3] + used_);
      compress(from.inverse_y, mask, packed_[4] + used_);
      compress(from.inverse_z, mask, packed_[5] + used_);
      compress(from.numbers, mask, packed_numbers_ + used_);
      used_ += std::popcount(mask);
    }
    // Lanes behind the last repeat a ray: no strange numbers in the arithmetic.
    for (float* lanes : packed_) fill_chunk(lanes, first);
    const int chunk_count = chunks_of(ray_count), first_chunk = first / kLaneCount;
    set_first_rays(packed_open_ + first_chunk, ray_count);
    used_ = first + chunk_count * kLaneCount;
    return {packed_[0] + first, packed_[1] + first, packed_[2] + first,      packed_[3] + first,
            packed_[4] + first, packed_[5] + first, packed_numbers_ + first, packed_open_ + first_chunk};
  }

  // Ends a set of so many rays, and closes those that it has closed.
  void unpack(const RaySet& packed, int ray_count) {
    std::uint16_t all[kMaxChunkCount];
    set_first_rays(all, ray_count);
    for (int chunk = 0; chunk < chunks_of(ray_count); ++chunk) {
      for (std::uint32_t closed = all[chunk] & ~static_cast<std::uint32_t>(packed.open[chunk]); closed != 0;
           closed &= closed - 1) {
        close(packed.numbers[chunk * kLaneCount + std::countr_zero(closed)]);
      }
    }
    used_ -= chunks_of(ray_count) * kLaneCount;
  }

  static int chunks_of(int ray_count) { return (ray_count + kLaneCount - 1) / kLaneCount; }

 private:
  // All sets at once: half of the rays, half of those, and so on; and what compress() overwrites.
  static constexpr int kPackedCount = kMaxRayCount + 2 * kLaneCount;

  // The reciprocal of zero and of denormals is made finite, as in BoxRay.
  static void invert(const float* from, int count, float* to) {
    const RayTag tag;
    const auto largest = hn::Set(tag, std::numeric_limits<float>::max()), one = hn::Set(tag, 1.0f);
    for (int i = 0; i < count; i += lane_count(tag)) {
      const auto inverse = hn::Div(one, hn::Load(tag, from + i));
      hn::Store(hn::Min(hn::Max(inverse, hn::Neg(largest)), largest), tag, to + i);
    }
  }

  static void set_first_rays(std::uint16_t* masks, int ray_count) {
    for (; ray_count >= kLaneCount; ray_count -= kLaneCount) *masks++ = 0xffff;
    if (ray_count > 0) *masks = static_cast<std::uint16_t>((1u << ray_count) - 1);
  }

  void fill_chunk(float* lanes, int first) const {
    const RayTag tag;
    for (int i = 0; i < kLaneCount; i += lane_count(tag)) {
      hn::StoreU(hn::Set(tag, lanes[first]), tag, lanes + used_ + i);
    }
  }

  RaySet all_;
  int used_ = 0;
  alignas(64) float inverse_x_[kMaxRayCount];
  alignas(64) float inverse_y_[kMaxRayCount];
  alignas(64) float inverse_z_[kMaxRayCount];
  alignas(64) std::uint32_t numbers_[kMaxRayCount];
  alignas(64) std::uint16_t open_[kMaxChunkCount];
  alignas(64) float packed_[6][kPackedCount];
  alignas(64) std::uint32_t packed_numbers_[kPackedCount];
  alignas(64) std::uint16_t packed_open_[kPackedCount / kLaneCount];
};
static_assert(std::endian::native == std::endian::little, "a chunk is 16 bits of a 64-bit word");

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
