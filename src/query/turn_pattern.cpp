// Compiled once for every SIMD target; the fastest that the processor has is chosen at run time. No fused
// multiply-adds: every target gives the same bits.
#include "query/turn_pattern.h"

#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/turn_pattern.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "lut/isa.h"
#include "lut/simd/mask_bits-inl.h"
#include "query/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::query::HWY_NAMESPACE {
namespace {

void turn_pattern(const PatternLanes& pattern, const glm::mat3& frame, float radius, const glm::vec3& up,
                  ReceiverRays& rays) {
  const Tag tag;
  constexpr int kLaneCount = static_cast<int>(hn::MaxLanes(Tag()));
  const glm::mat3 rows = glm::transpose(frame);
  const Vector to_x = splat(rows[0]), to_y = splat(rows[1]), to_z = splat(rows[2]), above = splat(up);
  const Floats scale = hn::Set(tag, radius), zero = hn::Zero(tag);
  for (int first = 0; first < rays.ray_count; first += 64) {
    std::uint64_t cast = 0;
    for (int bit = 0; bit < 64; bit += kLaneCount) {
      const int ray = first + bit;
      const auto i = static_cast<std::size_t>(ray);
      const Vector local{hn::LoadU(tag, &pattern.x[i]), hn::LoadU(tag, &pattern.y[i]), hn::LoadU(tag, &pattern.z[i])};
      const Floats length = hn::Mul(hn::LoadU(tag, &pattern.length[i]), scale);
      const Vector direction{dot(to_x, local), dot(to_y, local), dot(to_z, local)};
      hn::Store(hn::Mul(direction.x, length), tag, rays.x + ray);
      hn::Store(hn::Mul(direction.y, length), tag, rays.y + ray);
      hn::Store(hn::Mul(direction.z, length), tag, rays.z + ray);
      cast |= lut::HWY_NAMESPACE::long_bits_of(tag, hn::Gt(dot(direction, above), zero)) << bit;
    }
    rays.cast.words[first / 64] = cast;
  }
}

}  // namespace
}  // namespace lkao::query::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lkao::query {

HWY_EXPORT(turn_pattern);

void turn_pattern(const PatternLanes& pattern, const glm::mat3& frame, float radius, const glm::vec3& up,
                  ReceiverRays& rays) {
  LKAO_DISPATCH(turn_pattern)(pattern, frame, radius, up, rays);
}

}  // namespace lkao::query
#endif
