// Rays as vectors see them: component by component, 16 at a time. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_RAY_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_RAY_LANES_INL_H_
#undef LKAO_BVH_SIMD_RAY_LANES_INL_H_
#else
#define LKAO_BVH_SIMD_RAY_LANES_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include <hwy/highway.h>

#include "lkao/ambient_occlusion.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Rays of a chunk and of a packet; a mask of them fits 16 bits.
inline constexpr int kLaneCount = 16;
using RayTag = hn::CappedTag<float, kLaneCount>;

// 16 rays at successive places of six arrays.
struct RayLanes {
  const float *x, *y, *z;
  const float *inverse_x, *inverse_y, *inverse_z;
};

// All rays of a receiver.
struct RayArrays {
  const ReceiverRays* rays;
  alignas(64) float inverse_x[kMaxRayCount];
  alignas(64) float inverse_y[kMaxRayCount];
  alignas(64) float inverse_z[kMaxRayCount];

  RayLanes at(int ray) const {
    return {rays->x + ray, rays->y + ray, rays->z + ray, inverse_x + ray, inverse_y + ray, inverse_z + ray};
  }
};

// The lanes of a mask as bits. Reads just the bytes that were stored, so that no memory is touched in the end.
template <class Tag, class Mask>
HWY_INLINE std::uint32_t bits_of(Tag tag, Mask mask) {
  std::uint8_t bytes[8];
  hn::StoreMaskBits(tag, mask, bytes);
  if constexpr (hn::MaxLanes(Tag()) > 8) {
    std::uint16_t bits;
    std::memcpy(&bits, bytes, sizeof(bits));
    return bits;
  } else {
    return bytes[0];
  }
}

// The reciprocal of zero and of denormals is made finite, as in BoxRay.
inline void load_rays(const ReceiverRays& rays, RayArrays& arrays) {
  arrays.rays = &rays;
  const RayTag tag;
  const auto largest = hn::Set(tag, std::numeric_limits<float>::max()), one = hn::Set(tag, 1.0f);
  const auto invert = [&](const float* from, float* to) {
    for (int i = 0; i < rays.ray_count; i += static_cast<int>(hn::Lanes(tag))) {
      const auto inverse = hn::Div(one, hn::Load(tag, from + i));
      hn::Store(hn::Min(hn::Max(inverse, hn::Neg(largest)), largest), tag, to + i);
    }
  };
  invert(rays.x, arrays.inverse_x);
  invert(rays.y, arrays.inverse_y);
  invert(rays.z, arrays.inverse_z);
}

// A mask of all rays, chunk by chunk.
struct ChunkMask {
  static constexpr int kMaxChunkCount = kMaxRayCount / kLaneCount;

  ChunkMask() = default;
  explicit ChunkMask(const OcclusionMask& mask) { std::memcpy(chunks, mask.words, sizeof(chunks)); }
  OcclusionMask mask() const {
    OcclusionMask mask;
    std::memcpy(mask.words, chunks, sizeof(chunks));
    return mask;
  }

  alignas(32) std::uint16_t chunks[kMaxChunkCount];
};
static_assert(std::endian::native == std::endian::little, "a chunk is 16 bits of a 64-bit word");

// Some rays, by the chunks that have any.
struct ActiveChunks {
  ActiveChunks() = default;
  ActiveChunks(const ChunkMask& mask, int chunk_count) {
    for (int chunk = 0; chunk < chunk_count; ++chunk) add(chunk, mask.chunks[chunk]);
  }

  // Without branches: what is not there is overwritten by the next.
  HWY_INLINE void add(int chunk, std::uint32_t mask) {
    chunks[count] = static_cast<std::uint8_t>(chunk);
    masks[count] = static_cast<std::uint16_t>(mask);
    count += mask != 0;
    ray_count += std::popcount(mask);
  }

  // Those of them that are open.
  ActiveChunks open_ones(const ChunkMask& open) const {
    ActiveChunks result;
    for (int i = 0; i < count; ++i)
      result.add(chunks[i], static_cast<std::uint32_t>(masks[i]) & open.chunks[chunks[i]]);
    return result;
  }

  int count = 0;
  int ray_count = 0;
  std::uint8_t chunks[ChunkMask::kMaxChunkCount + 1];
  std::uint16_t masks[ChunkMask::kMaxChunkCount + 1];
};

// At most 16 rays of any chunks, side by side.
struct Packet {
  static constexpr int kSize = 2 * kLaneCount;
  alignas(64) float x[kSize];
  alignas(64) float y[kSize];
  alignas(64) float z[kSize];
  alignas(64) float inverse_x[kSize];
  alignas(64) float inverse_y[kSize];
  alignas(64) float inverse_z[kSize];
  std::uint16_t rays[kSize];  // their numbers
  int count = 0;

  RayLanes lanes() const { return {x, y, z, inverse_x, inverse_y, inverse_z}; }

  void gather(const RayArrays& from, const ActiveChunks& active) {
    for (int i = 0; i < active.count; ++i) {
      const int first = active.chunks[i] * kLaneCount;
      for (std::uint32_t bits = active.masks[i]; bits != 0; bits &= bits - 1) {
        const int ray = first + std::countr_zero(bits);
        x[count] = from.rays->x[ray], y[count] = from.rays->y[ray], z[count] = from.rays->z[ray];
        inverse_x[count] = from.inverse_x[ray];
        inverse_y[count] = from.inverse_y[ray];
        inverse_z[count] = from.inverse_z[ray];
        rays[count++] = static_cast<std::uint16_t>(ray);
      }
    }
    // Unused lanes repeat a ray: no uninitialised or strange numbers in the arithmetic.
    for (int i = count; i < kLaneCount; ++i) {
      x[i] = x[0], y[i] = y[0], z[i] = z[0];
      inverse_x[i] = inverse_x[0], inverse_y[i] = inverse_y[0], inverse_z[i] = inverse_z[0];
    }
  }

  // Takes the rays whose lanes are no longer open from the mask of open rays.
  void close_blocked(std::uint32_t open_lanes, ChunkMask& open) const {
    for (std::uint32_t lanes = ((1u << count) - 1) & ~open_lanes; lanes != 0; lanes &= lanes - 1) {
      const int ray = rays[std::countr_zero(lanes)];
      open.chunks[ray / kLaneCount] &= static_cast<std::uint16_t>(~(1u << (ray % kLaneCount)));
    }
  }
};

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
