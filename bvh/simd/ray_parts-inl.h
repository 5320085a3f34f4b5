// What of each ray counts. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_RAY_PARTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_RAY_PARTS_INL_H_
#undef LKAO_BVH_SIMD_RAY_PARTS_INL_H_
#else
#define LKAO_BVH_SIMD_RAY_PARTS_INL_H_
#endif

#include <cstdint>

#include <hwy/highway.h>

#include "bvh/query.h"
#include "bvh/ray_parts.h"
#include "bvh/simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

// Two classes with the same members, so that whole rays pay nothing for parts: where the rays begin and end to count,
// as shares of them. Of neighbouring rays from `first` on, or of one ray in all lanes.
//
// All of each ray.
struct WholeRays {
  static constexpr bool kHasParts = false;

  WholeRays() = default;
  explicit WholeRays(const Query&) {}

  template <class Tag>
  static HWY_INLINE hn::Vec<Tag> begin(Tag tag, int) {
    return hn::Zero(tag);
  }
  template <class Tag>
  static HWY_INLINE hn::Vec<Tag> end(Tag tag, int) {
    return hn::Set(tag, 1.0f);
  }
  template <class Tag>
  static HWY_INLINE hn::Vec<Tag> begin_of_one(Tag tag, std::uint32_t) {
    return hn::Zero(tag);
  }
  template <class Tag>
  static HWY_INLINE hn::Vec<Tag> end_of_one(Tag tag, std::uint32_t) {
    return hn::Set(tag, 1.0f);
  }
};

// The query's parts.
struct PartsOfRays {
  static constexpr bool kHasParts = true;

  explicit PartsOfRays(const Query& query) : parts(*query.parts) {}

  template <class Tag>
  HWY_INLINE hn::Vec<Tag> begin(Tag tag, int first) const {
    return hn::Load(tag, parts.begin + first);
  }
  template <class Tag>
  HWY_INLINE hn::Vec<Tag> end(Tag tag, int first) const {
    return hn::Load(tag, parts.end + first);
  }
  template <class Tag>
  HWY_INLINE hn::Vec<Tag> begin_of_one(Tag tag, std::uint32_t ray) const {
    return hn::Set(tag, parts.begin[ray]);
  }
  template <class Tag>
  HWY_INLINE hn::Vec<Tag> end_of_one(Tag tag, std::uint32_t ray) const {
    return hn::Set(tag, parts.end[ray]);
  }

  const RayParts& parts;
};

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
