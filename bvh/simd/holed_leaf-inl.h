// A triangle with holes against many rays. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_HOLED_LEAF_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_HOLED_LEAF_INL_H_
#undef LKAO_BVH_SIMD_HOLED_LEAF_INL_H_
#else
#define LKAO_BVH_SIMD_HOLED_LEAF_INL_H_
#endif

#include <bit>
#include <cstdint>

#include <hwy/highway.h>

#include "bvh/defined_triangle.h"
#include "bvh/simd/hole_squares-inl.h"
#include "bvh/simd/leaf_planes-inl.h"
#include "bvh/simd/ray_sets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

// One triangle of a leaf. Rays that meet it for sure are looked up in its squares, all of a chunk at once; those of
// mixed squares, and those in doubt, are asked one by one.
class HoledPlanes {
 public:
  HoledPlanes(const Layout& layout, const Query& query, const LeafPlanes& planes, int triangle, std::uint32_t primitive)
      : planes_(planes),
        triangle_(triangle),
        primitive_(primitive),
        squares_(layout.grids.get()),
        holed_(layout, query, primitive) {}

  // Of the rays `open` of a chunk, those that it blocks.
  template <class Parts>
  std::uint32_t blocked(const RaySet& rays, const Parts& parts, int chunk, std::uint32_t open) {
    const Verdict verdict = planes_.blocked(triangle_, rays, parts, chunk);
    const std::uint32_t sure = verdict.sure & open, in_doubt = verdict.perhaps & ~verdict.sure & open;
    KnownHoles known;
    if (sure != 0 && squares_.is_of_use()) known = planes_.known_holes(squares_, primitive_, triangle_, rays, chunk);
    std::uint32_t blocked = sure & known.opaque;
    for (std::uint32_t rest = sure & ~known.opaque & ~known.clear; rest != 0; rest &= rest - 1) {
      const int lane = std::countr_zero(rest);
      blocked |= static_cast<std::uint32_t>(holed_.blocks_met(chunk * kLaneCount + lane)) << lane;
    }
    for (std::uint32_t rest = in_doubt; rest != 0; rest &= rest - 1) {
      const int lane = std::countr_zero(rest);
      blocked |= static_cast<std::uint32_t>(holed_.blocks(chunk * kLaneCount + lane)) << lane;
    }
    return blocked;
  }

 private:
  const LeafPlanes& planes_;
  int triangle_;
  std::uint32_t primitive_;
  HoleSquares squares_;
  DefinedTriangle holed_;
};

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
