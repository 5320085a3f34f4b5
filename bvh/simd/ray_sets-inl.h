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

#include "bvh/query.h"
#include "bvh/simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

inline constexpr int kMaxChunkCount = kMaxRayCount / kLaneCount;

// The rays of a receiver, component by component, and those that are open: not yet blocked.
class RaySet {
 public:
  explicit RaySet(const Query& query)
      : x(query.rays.x),
        y(query.rays.y),
        z(query.rays.z),
        chunk_count((query.rays.ray_count + kLaneCount - 1) / kLaneCount) {
    std::memcpy(open, query.open.words, sizeof(open));
    invert(x, chunk_count * kLaneCount, inverse_x);
    invert(y, chunk_count * kLaneCount, inverse_y);
    invert(z, chunk_count * kLaneCount, inverse_z);
  }

  OcclusionMask open_mask() const {
    OcclusionMask mask;
    std::memcpy(mask.words, open, sizeof(open));
    return mask;
  }
  bool any_open() const { return open_mask().any(); }
  bool is_open(std::uint32_t ray) const { return (open[ray / kLaneCount] >> (ray % kLaneCount) & 1) != 0; }
  // Of rays by number, those that are open. Where a number is none of a ray there may be anything.
  template <class Tag>
  HWY_INLINE hn::Mask<Tag> are_open(Tag tag, hn::Vec<Tag> rays) const {
    static_assert(sizeof(hn::TFromD<Tag>) == 4);
    constexpr int kTableSize = static_cast<int>(hn::MaxLanes(Tag()));
    const auto* const table = reinterpret_cast<const std::uint32_t*>(open);  // loads of vectors may alias anything
    const hn::RebindToSigned<Tag> number_tag;
    const auto word_number =
        hn::BitCast(number_tag, hn::And(hn::ShiftRight<5>(rays), hn::Set(tag, kMaxRayCount / 32 - 1)));
    const auto look_up = [&](int first) HWY_ATTR {
      const auto place = hn::And(word_number, hn::Set(number_tag, kTableSize - 1));
      return hn::TableLookupLanes(hn::Load(tag, table + first), hn::IndicesFromVec(tag, place));
    };
    auto word = look_up(0);
    for (int first = kTableSize; 2 * first < chunk_count; first += kTableSize) {
      const auto is_there = hn::RebindMask(tag, hn::Gt(word_number, hn::Set(number_tag, first - 1)));
      word = hn::IfThenElse(is_there, look_up(first), word);
    }
    return hn::TestBit(word, hn::Set(tag, 1u) << hn::And(rays, hn::Set(tag, 31u)));
  }
  // Without a branch: nothing where `blocked` is 0 instead of 1.
  void close(std::uint32_t ray, std::uint32_t blocked) {
    open[ray / kLaneCount] &= static_cast<std::uint16_t>(~(blocked << (ray % kLaneCount)));
  }

  // The rays of some lanes of a chunk have this blocker.
  HWY_INLINE void set_blocker(int chunk, std::uint32_t lanes, std::uint32_t leaf) {
    const hn::RebindToUnsigned<RayTag> tag;
    for (int i = 0; i < kLaneCount; i += lane_count(tag)) {
      const std::uint32_t some = lanes >> i & ((1u << lane_count(tag)) - 1);
      hn::BlendedStore(hn::Set(tag, leaf), mask_of(tag, some), tag, &blockers[chunk * kLaneCount + i]);
    }
  }

  // Components shorter than half the margin of boxes count as that long, so that no product with a face overflows:
  // along such a component the ray leaves the box no later than it did.
  static constexpr float kShortest = 0.5f * Node::kMargin;
  static void invert(const float* from, int count, float* to) {
    const RayTag tag;
    const auto shortest = hn::Set(tag, kShortest);
    for (int i = 0; i < count; i += lane_count(tag)) {
      const auto component = hn::Load(tag, from + i);
      const auto limited = hn::CopySign(hn::Max(hn::Abs(component), shortest), component);
      hn::Store(reciprocal(tag, limited), tag, to + i);
    }
  }

  const float *x, *y, *z;
  alignas(64) float inverse_x[kMaxRayCount];
  alignas(64) float inverse_y[kMaxRayCount];
  alignas(64) float inverse_z[kMaxRayCount];
  int chunk_count;
  // By ray, the leaf that blocked it, where blockers are remembered; behind the rays is room for what is none.
  std::uint32_t blockers[kMaxRayCount + kLaneCount];
  alignas(64) std::uint16_t open[kMaxChunkCount];
};
static_assert(kMaxChunkCount <= 64);
static_assert(std::endian::native == std::endian::little, "a chunk is 16 bits of a 64-bit word");

// Masks of rays by chunk number. A whole number of vectors, so that loops over them need no remainder.
struct alignas(64) ChunkMasks {
  HWY_INLINE void clear(int chunk_count) {
    const hn::CappedTag<std::uint16_t, 8> tag;
    for (int i = 0; i < chunk_count; i += 8) {
      for (int k = i; k < i + 8; k += lane_count(tag)) hn::Store(hn::Zero(tag), tag, of + k);
    }
  }

  // What is in both, for the first `chunk_count` chunks.
  HWY_INLINE void set_to_and(const std::uint16_t* a, const std::uint16_t* b, int chunk_count) {
    const hn::CappedTag<std::uint16_t, 8> tag;
    for (int i = 0; i < chunk_count; i += 8) {
      for (int k = i; k < i + 8; k += lane_count(tag)) {
        hn::Store(hn::And(hn::Load(tag, a + k), hn::Load(tag, b + k)), tag, of + k);
      }
    }
  }

  std::uint16_t of[kMaxChunkCount];
};

// Some rays: their masks by chunk number, the chunks that have any, and their number.
struct ActiveRays {
  ActiveRays() = default;
  // Of which neither chunks nor number are known yet.
  HWY_INLINE ActiveRays(const std::uint16_t* the_masks, int chunk_count) : masks(the_masks), chunks(0), count(0) {
    const hn::CappedTag<std::uint16_t, 8> tag;
    for (int i = 0; i < chunk_count; i += 8) {
      for (int k = i; k < i + 8; k += lane_count(tag)) {
        const auto some = hn::Ne(hn::Load(tag, masks + k), hn::Zero(tag));
        chunks |= long_bits_of(tag, some) << k;
      }
      std::uint64_t words[2];
      std::memcpy(words, masks + i, sizeof(words));
      count += std::popcount(words[0]) + std::popcount(words[1]);
    }
  }
  ActiveRays(const std::uint16_t* the_masks, std::uint64_t the_chunks, int the_count)
      : masks(the_masks), chunks(the_chunks), count(the_count) {}

  const std::uint16_t* masks;
  std::uint64_t chunks;
  int count;
};

// Calls `function(chunk)` for every bit.
template <typename Function>
HWY_INLINE void for_each_chunk(std::uint64_t chunks, const Function& function) {
  for (; chunks != 0; chunks &= chunks - 1) function(std::countr_zero(chunks));
}

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
