// Compiled once for every SIMD target; the fastest that the processor has is chosen at run time. No fused
// multiply-adds: every target gives the same bits.
#include "lut/plane_mask_fill.h"

#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lut/plane_mask_fill.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "lut/isa.h"
#include "lut/simd/mask_bits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::lut::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, 16>;
using Floats = hn::Vec<Tag>;
using Bits = hn::Mask<Tag>;

// `beyond(axis . P, |P|)` for every ray, packed into words. Writes what `beyond` returns for each of kMasks masks.
template <int kMasks, typename Beyond>
void fill(const RayEnds& ends, const glm::vec3& axis, std::uint64_t* const (&words)[kMasks], const Beyond& beyond) {
  const Tag tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const Floats nx = hn::Set(tag, axis.x), ny = hn::Set(tag, axis.y), nz = hn::Set(tag, axis.z);
  for (int word = 0; word < ends.word_count; ++word) {
    std::uint64_t packed[kMasks] = {};
    for (int bit = 0; bit < 64; bit += lanes) {
      const int ray = word * 64 + bit;
      const Floats height = hn::Add(hn::Add(hn::Mul(nx, hn::LoadU(tag, &ends.x[static_cast<std::size_t>(ray)])),
                                            hn::Mul(ny, hn::LoadU(tag, &ends.y[static_cast<std::size_t>(ray)]))),
                                    hn::Mul(nz, hn::LoadU(tag, &ends.z[static_cast<std::size_t>(ray)])));
      Bits masks[kMasks];
      beyond(height, hn::LoadU(tag, &ends.length[static_cast<std::size_t>(ray)]), masks);
      for (int i = 0; i < kMasks; ++i) {
        packed[i] |= long_bits_of(tag, masks[i]) << bit;
      }
    }
    const std::uint64_t rays = word + 1 < ends.word_count ? ~std::uint64_t{0} : ends.last_word;
    for (int i = 0; i < kMasks; ++i) words[i][word] = packed[i] & rays;
  }
}

void fill_nearest(const RayEnds& ends, const PlaneCell& cell, std::uint64_t* words) {
  const Tag tag;
  const Floats distance = hn::Set(tag, cell.distance);
  fill<1>(ends, cell.axis, {words},
          [&](Floats height, Floats, Bits(&masks)[1]) { masks[0] = hn::Ge(height, distance); });
}

// Bounds the rounding of |P|^2 - (axis . P)^2, of which the root would make much where P is close to the axis.
constexpr float kSquareRounding = 0x1p-20f;

// With P at angle phi from the axis, the planes of the cell see n . P between |P| cos(phi + angle) and
// |P| cos(phi - angle), the latter |P| where phi < angle (lut/README.md).
void fill_must_may(const RayEnds& ends, const PlaneCell& cell, std::uint64_t* must, std::uint64_t* may) {
  const Tag tag;
  const Floats cos = hn::Set(tag, cell.angle_cos), sin = hn::Set(tag, cell.angle_sin);
  const Floats zero = hn::Zero(tag), rounding = hn::Set(tag, kSquareRounding);
  const Floats farthest = hn::Set(tag, cell.farthest_distance + kPlaneMargin);
  const Floats nearest = hn::Set(tag, cell.nearest_distance - kPlaneMargin);
  fill<2>(ends, cell.axis, {must, may}, [&](Floats height, Floats length, Bits(&masks)[2]) {
    const Floats across2 = hn::Sub(hn::Mul(length, length), hn::Mul(height, height));
    const Floats across = hn::Sqrt(hn::Add(hn::Max(across2, zero), rounding));
    const Floats inward = hn::Mul(height, cos), sideways = hn::Mul(across, sin);
    const Bits within_cone = hn::Ge(height, hn::Mul(length, cos));
    const Floats highest = hn::IfThenElse(within_cone, length, hn::Add(inward, sideways));
    masks[0] = hn::Ge(hn::Sub(inward, sideways), farthest);
    masks[1] = hn::Ge(highest, nearest);
  });
}

}  // namespace
}  // namespace lkao::lut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lkao::lut {

HWY_EXPORT(fill_nearest);
HWY_EXPORT(fill_must_may);

void fill_nearest(const RayEnds& ends, const PlaneCell& cell, std::uint64_t* words) {
  LKAO_DISPATCH(fill_nearest)(ends, cell, words);
}

void fill_must_may(const RayEnds& ends, const PlaneCell& cell, std::uint64_t* must, std::uint64_t* may) {
  LKAO_DISPATCH(fill_must_may)(ends, cell, must, may);
}

}  // namespace lkao::lut
#endif
