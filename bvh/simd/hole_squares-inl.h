// What is known of the holes of triangles where rays meet them. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_HOLE_SQUARES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_HOLE_SQUARES_INL_H_
#undef LKAO_BVH_SIMD_HOLE_SQUARES_INL_H_
#else
#define LKAO_BVH_SIMD_HOLE_SQUARES_INL_H_
#endif

#include <cstdint>

#include <hwy/highway.h>

#include "bvh/hole_grids.h"
#include "bvh/simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

// Where rays meet triangles: at (u, v), each known but for `away`.
template <class Tag>
struct Places {
  hn::Vec<Tag> u, v, away;
};

// Bits of lanes where rays pass for sure, and where they are blocked for sure.
struct KnownHoles {
  std::uint32_t clear = 0;
  std::uint32_t opaque = 0;
};

// HoleGrids, many lanes at once.
class HoleSquares {
 public:
  // Null: nothing is known.
  explicit HoleSquares(const HoleGrids* grids)
      : entries_(grids != nullptr ? grids->entries() : nullptr), words_(grids != nullptr ? grids->words() : nullptr) {}

  bool is_of_use() const { return entries_ != nullptr; }

  // Of one triangle.
  template <class Tag>
  HWY_INLINE KnownHoles at(Tag tag, std::uint32_t primitive, const Places<Tag>& places) const {
    return look_up(tag, hn::Set(hn::RebindToSigned<Tag>(), static_cast<std::int32_t>(entries_[primitive])), places);
  }

  // Of a triangle a lane.
  template <class Tag>
  HWY_INLINE KnownHoles at(Tag tag, hn::Vec<hn::RebindToSigned<Tag>> primitives, const Places<Tag>& places) const {
    const hn::RebindToSigned<Tag> number_tag;
    const auto* const entries = reinterpret_cast<const std::int32_t*>(entries_);
    return look_up(tag, hn::GatherIndex(number_tag, entries, primitives), places);
  }

 private:
  template <class Tag>
  HWY_INLINE KnownHoles look_up(Tag tag, hn::Vec<hn::RebindToSigned<Tag>> entries, const Places<Tag>& places) const {
    const hn::RebindToSigned<Tag> number_tag;
    const hn::RebindToUnsigned<Tag> bits_tag;
    const auto level = hn::BitCast(number_tag, hn::ShiftRight<HoleGrids::kLevelShift>(hn::BitCast(bits_tag, entries)));
    const auto first = hn::And(entries, hn::Set(number_tag, (1 << HoleGrids::kLevelShift) - 1));
    const auto size = hn::BitCast(tag, hn::ShiftLeft<23>(hn::Add(level, hn::Set(number_tag, 127))));
    const auto last = hn::Sub(hn::ConvertTo(number_tag, size), hn::Set(number_tag, 1));
    const auto square_of = [&](hn::Vec<Tag> coordinate) HWY_ATTR {
      const auto place = hn::ConvertTo(number_tag, hn::Mul(coordinate, size));
      return hn::Min(hn::Max(place, hn::Zero(number_tag)), last);
    };
    const auto column = square_of(hn::Sub(places.u, places.away)), row = square_of(hn::Sub(places.v, places.away));
    // All that the ray may meet is in one square. `!(x < y)` holds for NaN too.
    const auto one = hn::And(hn::Eq(column, square_of(hn::Add(places.u, places.away))),
                             hn::Eq(row, square_of(hn::Add(places.v, places.away))));
    const std::uint32_t is_one = bits_of(number_tag, one) & bits_of(tag, hn::Lt(places.away, hn::Set(tag, 1.0f)));
    const auto square = hn::Add(hn::Shl(row, level), column);
    const auto* const words = reinterpret_cast<const std::int32_t*>(words_);
    const auto word = hn::GatherIndex(number_tag, words, hn::Add(first, hn::ShiftRight<4>(square)));
    const auto shift = hn::ShiftLeft<1>(hn::And(square, hn::Set(number_tag, HoleGrids::kSquaresAWord - 1)));
    const auto part = hn::And(hn::Shr(word, shift), hn::Set(number_tag, 3));
    const auto is = [&](CutOutPart what) HWY_ATTR {
      return bits_of(number_tag, hn::Eq(part, hn::Set(number_tag, static_cast<std::int32_t>(what)))) & is_one;
    };
    return {is(CutOutPart::clear), is(CutOutPart::opaque)};
  }

  const std::uint32_t *entries_, *words_;
};

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
