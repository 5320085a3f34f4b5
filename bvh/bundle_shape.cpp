// Compiled once for every SIMD target; the fastest that the processor has is chosen at run time. Lengths are taken
// without fused multiply-adds, so that every target finds the same.
#include "bvh/bundle_shape.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>

#include "lut/coordinates.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bvh/bundle_shape.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "lut/isa.h"
#include "lut/simd/mask_bits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, PatternCones::kRaysPerCone>;
using Floats = hn::Vec<Tag>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
constexpr int kRaysPerCone = PatternCones::kRaysPerCone;

// Of squares of lengths: what is shorter than a 1024th of the longest ray is left to another shape.
constexpr float kShortest2 = 0x1p-20f;

HWY_INLINE hn::Mask<Tag> mask_of(std::uint32_t bits) {
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8)};
  return hn::LoadMaskBits(Tag(), bytes);
}

// Bits of as many rays as a vector holds, from ray `first` on.
HWY_INLINE std::uint32_t bits_at(const OcclusionMask& mask, int first) {
  return static_cast<std::uint32_t>(mask.words[first / 64] >> (first % 64)) & ((1u << kLanes) - 1);
}

HWY_INLINE Floats largest_component(const ReceiverRays& rays, int first) {
  const Tag tag;
  const auto x = hn::Abs(hn::Load(tag, rays.x + first)), y = hn::Abs(hn::Load(tag, rays.y + first)),
             z = hn::Abs(hn::Load(tag, rays.z + first));
  return hn::Max(x, hn::Max(y, z));
}

bool are_in_range(const ReceiverRays& rays) {
  const Tag tag;
  const auto most = hn::Set(tag, lut::kLargestCoordinate);
  std::uint32_t bad = 0;
  for (int i = 0; i < rays.word_count() * 64; i += kLanes) {
    // Components one by one: maxima may drop what is no number.
    const auto is_good = [&](const float* components)
                             HWY_ATTR { return hn::Le(hn::Abs(hn::Load(tag, components + i)), most); };
    const auto all = hn::And(is_good(rays.x), hn::And(is_good(rays.y), is_good(rays.z)));
    bad |= lut::HWY_NAMESPACE::bits_of(tag, hn::Not(all)) & ((1u << kLanes) - 1);
  }
  return bad == 0;
}

// Rays as they are here: scaled by a power of two, so that no square overflows, and none vanishes that counts.
class ScaledRays {
 public:
  ScaledRays(const ReceiverRays& rays, const OcclusionMask& left) : rays_(rays), count_(rays.word_count() * 64) {
    const Tag tag;
    auto largest = hn::Zero(tag);
    for (int i = 0; i < count_; i += kLanes) {
      largest = hn::Max(largest, hn::IfThenElseZero(mask_of(bits_at(left, i)), largest_component(rays, i)));
    }
    const float most = hn::GetLane(hn::MaxOfLanes(tag, largest));
    exponent_ = most > 0 ? std::max(std::ilogb(most), -126) : 0;
    scale_ = std::ldexp(1.0f, -exponent_);

    auto longest2 = hn::Zero(tag);
    for (int i = 0; i < count_; i += kLanes) {
      const auto x = component(rays.x, i), y = component(rays.y, i), z = component(rays.z, i);
      const auto length2 =
          hn::IfThenElseZero(mask_of(bits_at(left, i)), hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z)));
      hn::Store(length2, tag, length2_ + i);
      longest2 = hn::Max(longest2, length2);
    }
    longest2_ = hn::GetLane(hn::MaxOfLanes(tag, longest2));
  }

  int count() const { return count_; }
  // A little more than the longest ray.
  float radius() const { return std::ldexp(std::sqrt(longest2_) * (1 + 0x1p-20f), exponent_); }
  HWY_INLINE Floats component(const float* components, int first) const {
    return hn::Mul(hn::Load(Tag(), components + first), hn::Set(Tag(), scale_));
  }
  // Rays that are long enough for the shape of the longest.
  HWY_INLINE hn::Mask<Tag> are_long(int first) const {
    const Tag tag;
    const float least = std::max(longest2_ * kShortest2, 1e-30f);
    return hn::Ge(hn::Load(tag, length2_ + first), hn::Set(tag, least));
  }
  // 1 / length of the scaled rays. Of long ones alone.
  HWY_INLINE Floats inverse_length(int first) const {
    const Tag tag;
    return hn::Div(hn::Set(tag, 1.0f), hn::Sqrt(hn::Load(tag, length2_ + first)));
  }
  bool is_empty() const { return !(longest2_ > 0); }

 private:
  const ReceiverRays& rays_;
  int count_;
  int exponent_;
  float scale_;
  float longest2_;
  alignas(64) float length2_[kMaxRayCount];
};

// Unit vectors, zero where a ray is of no account.
class Directions {
 public:
  Directions(const ReceiverRays& rays, const ScaledRays& scaled, OcclusionMask& mask) {
    const Tag tag;
    for (int i = 0; i < scaled.count(); i += kLanes) {
      const auto are_long = scaled.are_long(i);
      mask.words[i / 64] |= std::uint64_t{lut::HWY_NAMESPACE::bits_of(tag, are_long)} << (i % 64);
      const auto inverse = scaled.inverse_length(i);
      const auto store = [&](const float* components, float* to) HWY_ATTR {
        hn::Store(hn::IfThenElseZero(are_long, hn::Mul(scaled.component(components, i), inverse)), tag, to + i);
      };
      store(rays.x, x_);
      store(rays.y, y_);
      store(rays.z, z_);
    }
  }

  // Of the rays of one cone.
  HWY_INLINE glm::vec3 sum(int first) const {
    const auto of = [&](const float* components) HWY_ATTR {
      const Tag tag;
      auto total = hn::Load(tag, components + first);
      for (int i = kLanes; i < kRaysPerCone; i += kLanes) total = hn::Add(total, hn::Load(tag, components + first + i));
      return hn::GetLane(hn::SumOfLanes(tag, total));
    };
    return {of(x_), of(y_), of(z_)};
  }

  // The least cosine of a ray of the cone with a unit vector; 1 where there is no ray.
  HWY_INLINE float least_cosine(int first, const glm::vec3& axis, const OcclusionMask& mask) const {
    const Tag tag;
    auto least = hn::Set(tag, 1.0f);
    for (int i = first; i < first + kRaysPerCone; i += kLanes) {
      const auto along = hn::MulAdd(hn::Load(tag, x_ + i), hn::Set(tag, axis.x),
                                    hn::MulAdd(hn::Load(tag, y_ + i), hn::Set(tag, axis.y),
                                               hn::Mul(hn::Load(tag, z_ + i), hn::Set(tag, axis.z))));
      least = hn::Min(least, hn::IfThenElse(mask_of(bits_at(mask, i)), along, hn::Set(tag, 1.0f)));
    }
    return hn::GetLane(hn::MinOfLanes(tag, least));
  }

 private:
  alignas(64) float x_[kMaxRayCount], y_[kMaxRayCount], z_[kMaxRayCount];
};

HWY_INLINE glm::vec3 unit_or_z(const glm::vec3& v) {
  const float length2 = glm::dot(v, v);
  return length2 > 1e-12f ? v / std::sqrt(length2) : glm::vec3(0, 0, 1);
}

// Any rotation that has `axis` as its last column.
glm::mat3 frame_around(const glm::vec3& axis) {
  const glm::vec3 other = std::fabs(axis.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  const glm::vec3 tangent = glm::normalize(glm::cross(other, axis));
  return {tangent, glm::cross(axis, tangent), axis};
}

void set_cone(PatternCones& cones, int i, const glm::vec3& axis, float cosine) {
  // Rounding: of directions, of the axis, which was turned into the frame, and of their products.
  cosine -= 2e-6f;
  cones.x[i] = axis.x;
  cones.y[i] = axis.y;
  cones.z[i] = axis.z;
  // Beyond a right angle there is nothing to gain: the whole circle.
  cones.cosine[i] = cosine > 0 ? cosine : -1.0f;
  cones.sine[i] = cosine > 0 ? std::sqrt((1 - cosine) * (1 + cosine)) + 1e-7f : 1.0f;
}

void make_bundle_shape(const ReceiverRays& rays, const OcclusionMask& left, BundleShape& shape) {
  shape.rays = OcclusionMask();
  const ScaledRays scaled(rays, left);
  if (scaled.is_empty()) return;
  shape.radius = scaled.radius();
  const Directions directions(rays, scaled, shape.rays);

  const int cone_count = scaled.count() / kRaysPerCone;
  glm::vec3 sums[PatternCones::kMaxCount], total(0);
  for (int i = 0; i < cone_count; ++i) {
    sums[i] = directions.sum(i * kRaysPerCone);
    total += sums[i];
  }
  const glm::vec3 middle = unit_or_z(total);
  shape.frame = frame_around(middle);
  const glm::mat3 to_local = glm::transpose(shape.frame);
  float widest = 1;
  for (int i = 0; i < cone_count; ++i) {
    const int first = i * kRaysPerCone;
    const glm::vec3 axis = unit_or_z(sums[i]);
    set_cone(shape.cones, i, to_local * axis, directions.least_cosine(first, axis, shape.rays));
    widest = std::min(widest, directions.least_cosine(first, middle, shape.rays));
  }
  // Vectors of cones are loaded whole.
  for (int i = cone_count; i % kRaysPerCone != 0; ++i) set_cone(shape.cones, i, glm::vec3(0, 0, 1), -1);
  widest -= 2e-6f;
  const bool is_narrow = widest > 1e-3f;
  shape.up = is_narrow ? middle : glm::vec3(0);
  shape.cones.widest_cosine = is_narrow ? widest : -1.0f;
  shape.cones.widest_sine = is_narrow ? std::sqrt((1 - widest) * (1 + widest)) + 1e-6f : 1.0f;
}

}  // namespace
}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lkao::bvh {

HWY_EXPORT(are_in_range);
HWY_EXPORT(make_bundle_shape);

bool are_in_range(const ReceiverRays& rays) { return LKAO_DISPATCH(are_in_range)(rays); }

void make_bundle_shape(const ReceiverRays& rays, const OcclusionMask& left, BundleShape& shape) {
  LKAO_DISPATCH(make_bundle_shape)(rays, left, shape);
}

}  // namespace lkao::bvh
#endif
