// Which cell of directions each ray goes through. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_DIRECTION_CELLS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_DIRECTION_CELLS_INL_H_
#undef LKAO_BVH_SIMD_DIRECTION_CELLS_INL_H_
#else
#define LKAO_BVH_SIMD_DIRECTION_CELLS_INL_H_
#endif

#include <cstdint>

#include <hwy/highway.h>

#include "bvh/blocker_memory.h"
#include "bvh/simd/lanes-inl.h"
#include "bvh/simd/ray_sets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

// A cell of the octahedron for each ray, by number; some cell where a ray has no direction.
HWY_INLINE void find_cells(const RaySet& rays, std::uint32_t* cells) {
  const RayTag tag;
  const hn::RebindToSigned<RayTag> int_tag;
  const hn::RebindToUnsigned<RayTag> number_tag;
  constexpr int kCells = BlockerMemory::kCellsPerAxis;
  const auto one = hn::Set(tag, 1.0f), half = hn::Set(tag, 0.5f * static_cast<float>(kCells));
  const auto number = [&](auto coordinate) HWY_ATTR {
    const auto cell = hn::ConvertTo(int_tag, hn::MulAdd(coordinate, half, half));
    return hn::Min(hn::Max(cell, hn::Zero(int_tag)), hn::Set(int_tag, kCells - 1));
  };
  for (int i = 0; i < rays.chunk_count * kLaneCount; i += lane_count(tag)) {
    const auto x = hn::Load(tag, rays.x + i), y = hn::Load(tag, rays.y + i), z = hn::Load(tag, rays.z + i);
    const auto scale = reciprocal(tag, hn::Add(hn::Abs(x), hn::Add(hn::Abs(y), hn::Abs(z))));
    const auto u = hn::Mul(x, scale), v = hn::Mul(y, scale);
    // The lower half is folded over the diagonals.
    const auto is_below = hn::Lt(z, hn::Zero(tag));
    const auto column = number(hn::IfThenElse(is_below, hn::CopySign(hn::Sub(one, hn::Abs(v)), u), u));
    const auto row = number(hn::IfThenElse(is_below, hn::CopySign(hn::Sub(one, hn::Abs(u)), v), v));
    const auto cell = hn::Add(hn::Mul(row, hn::Set(int_tag, kCells)), column);
    hn::Store(hn::BitCast(number_tag, cell), number_tag, cells + i);
  }
}

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
