// Compiled once for every SIMD target; the fastest that the processor has is chosen at run time. Lengths are taken
// without fused multiply-adds, so that every target finds the same.
#include "bvh/bundle_shape.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <glm/common.hpp>
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

// Of cosines: of lengths, of the axis, which was turned into the frame, and of products.
constexpr float kRounding = 4e-6f;

// The cosine of the widest angle to the middle at which a bundle is best told by the intervals of its components.
constexpr float kNarrow = 0.7f;

HWY_INLINE hn::Mask<Tag> mask_of(std::uint32_t bits) {
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8)};
  return hn::LoadMaskBits(Tag(), bytes);
}

// Bits of as many rays as a vector holds, from ray `first` on.
HWY_INLINE std::uint32_t bits_at(const OcclusionMask& mask, int first) {
  return static_cast<std::uint32_t>(mask.words[first / 64] >> (first % 64)) & ((1u << kLanes) - 1);
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

HWY_INLINE glm::vec3 unit_or_z(const glm::vec3& v) {
  const float length2 = glm::dot(v, v);
  return length2 > 1e-12f ? v / std::sqrt(length2) : glm::vec3(0, 0, 1);
}

// The rays in question, and what is found of them in one go. Where squares of their lengths might leave the range of
// floats, all is scaled by a power of two.
class MeasuredRays {
 public:
  MeasuredRays(const ReceiverRays& rays, const OcclusionMask& left)
      : rays_(rays), count_((rays.ray_count + kRaysPerCone - 1) / kRaysPerCone * kRaysPerCone) {
    measure(left, 1);
    if (!(longest2_ > 1e-25f && longest2_ < 1e30f)) measure_scaled(left);
  }

  bool is_empty() const { return !(longest2_ > 0); }
  int cone_count() const { return count_ / kRaysPerCone; }
  // A little more than the longest ray.
  float radius() const { return std::ldexp(std::sqrt(longest2_) * (1 + 0x1p-20f), exponent_); }
  // Those that are long enough for the shape of the longest.
  OcclusionMask long_rays() const {
    const Tag tag;
    OcclusionMask mask;
    const auto least = hn::Set(tag, longest2_ * kShortest2);
    for (int i = 0; i < count_; i += kLanes) {
      const std::uint64_t bits = lut::HWY_NAMESPACE::long_bits_of(tag, hn::Ge(hn::Load(tag, length2_ + i), least));
      mask.words[i / 64] |= bits << (i % 64);
    }
    return mask;
  }
  // What all components of the rays that were left lie between.
  glm::vec3 least() const { return least_; }
  glm::vec3 most() const { return most_; }
  // The direction of the middle of that box.
  glm::vec3 middle() const { return unit_or_z(scale_ * (0.5f * least_ + 0.5f * most_)); }
  // True where nothing in the box is farther than kNarrow from there: spares a look at each ray.
  bool is_narrow_box() const {
    const glm::vec3 center = scale_ * (0.5f * least_ + 0.5f * most_), half = scale_ * (0.5f * most_ - 0.5f * least_);
    constexpr float kSine2 = 1 - kNarrow * kNarrow - kRounding;
    const float distance2 = glm::dot(center, center);
    return distance2 > 1e-12f && glm::dot(half, half) < kSine2 * distance2;
  }

  // Of those rays of the mask whose numbers are from `first` to before `last`, multiples of the rays of a cone; scaled.
  HWY_INLINE glm::vec3 sum(int first, int last, const OcclusionMask& mask) const {
    const Tag tag;
    auto x = hn::Zero(tag), y = x, z = x;
    for (int i = first; i < last; i += kLanes) {
      const auto is_in = mask_of(bits_at(mask, i));
      x = hn::Add(x, hn::IfThenElseZero(is_in, component(rays_.x, i)));
      y = hn::Add(y, hn::IfThenElseZero(is_in, component(rays_.y, i)));
      z = hn::Add(z, hn::IfThenElseZero(is_in, component(rays_.z, i)));
    }
    const auto total = [&](Floats v) HWY_ATTR { return hn::GetLane(hn::SumOfLanes(tag, v)); };
    return {total(x), total(y), total(z)};
  }

  // The least cosine of such rays with a unit vector; 1 where there is none.
  HWY_INLINE float least_cosine(int first, int last, const glm::vec3& axis, const OcclusionMask& mask) const {
    const Tag tag;
    const auto one = hn::Set(tag, 1.0f);
    auto least = one;
    for (int i = first; i < last; i += kLanes) {
      const auto along = hn::MulAdd(component(rays_.x, i), hn::Set(tag, axis.x),
                                    hn::MulAdd(component(rays_.y, i), hn::Set(tag, axis.y),
                                               hn::Mul(component(rays_.z, i), hn::Set(tag, axis.z))));
      const auto cosine = hn::Mul(along, inverse_root(hn::Load(tag, length2_ + i)));
      least = hn::Min(least, hn::IfThenElse(mask_of(bits_at(mask, i)), cosine, one));
    }
    return hn::GetLane(hn::MinOfLanes(tag, least));
  }

 private:
  HWY_INLINE Floats component(const float* components, int first) const {
    return hn::Mul(hn::Load(Tag(), components + first), hn::Set(Tag(), scale_));
  }

  // Within 2^-20 or so: the estimate has 11 bits at least.
  static HWY_INLINE Floats inverse_root(Floats v) {
    const Tag tag;
    const auto estimate = hn::ApproximateReciprocalSqrt(v), half = hn::Mul(v, hn::Set(tag, 0.5f));
    return hn::Mul(estimate, hn::NegMulAdd(hn::Mul(half, estimate), estimate, hn::Set(tag, 1.5f)));
  }

  void measure(const OcclusionMask& left, float scale) {
    scale_ = scale;
    const Tag tag;
    const auto infinity = hn::Set(tag, std::numeric_limits<float>::infinity());
    Floats least[3] = {infinity, infinity, infinity},
           most[3] = {hn::Neg(infinity), hn::Neg(infinity), hn::Neg(infinity)};
    auto longest2 = hn::Zero(tag);
    const float* const components[] = {rays_.x, rays_.y, rays_.z};
    for (int i = 0; i < count_; i += kLanes) {
      const auto is_in = mask_of(bits_at(left, i));
      auto length2 = hn::Zero(tag);
      for (int axis = 0; axis < 3; ++axis) {
        const auto value = hn::Load(tag, components[axis] + i), scaled = component(components[axis], i);
        length2 = hn::Add(length2, hn::Mul(scaled, scaled));
        least[axis] = hn::Min(least[axis], hn::IfThenElse(is_in, value, infinity));
        most[axis] = hn::Max(most[axis], hn::IfThenElse(is_in, value, hn::Neg(infinity)));
      }
      length2 = hn::IfThenElseZero(is_in, length2);
      hn::Store(length2, tag, length2_ + i);
      longest2 = hn::Max(longest2, length2);
    }
    longest2_ = hn::GetLane(hn::MaxOfLanes(tag, longest2));
    for (int axis = 0; axis < 3; ++axis) {
      least_[axis] = hn::GetLane(hn::MinOfLanes(tag, least[axis]));
      most_[axis] = hn::GetLane(hn::MaxOfLanes(tag, most[axis]));
    }
  }

  HWY_NOINLINE void measure_scaled(const OcclusionMask& left) {
    const glm::vec3 size = glm::max(glm::abs(least_), glm::abs(most_));
    const float largest = std::max(size.x, std::max(size.y, size.z));
    if (!(largest > 0) || std::isinf(largest)) return;  // no rays, or none with a length
    exponent_ = std::max(std::ilogb(largest), -126);
    measure(left, std::ldexp(1.0f, -exponent_));
  }

  const ReceiverRays& rays_;
  int count_;  // up to whole cones
  int exponent_ = 0;
  float scale_ = 1, longest2_ = 0;
  glm::vec3 least_{0}, most_{0};
  alignas(64) float length2_[kMaxRayCount];
};

// Any rotation that has `axis` as its last column.
glm::mat3 frame_around(const glm::vec3& axis) {
  const glm::vec3 other = std::fabs(axis.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
  const glm::vec3 tangent = glm::normalize(glm::cross(other, axis));
  return {tangent, glm::cross(axis, tangent), axis};
}

void set_cone(PatternCones& cones, int i, const glm::vec3& axis, float cosine) {
  cosine -= kRounding;
  cones.x[i] = axis.x;
  cones.y[i] = axis.y;
  cones.z[i] = axis.z;
  // Beyond a right angle there is nothing to gain: the whole circle.
  cones.cosine[i] = cosine > 0 ? cosine : -1.0f;
  cones.sine[i] = cosine > 0 ? std::sqrt((1 - cosine) * (1 + cosine)) + 1e-7f : 1.0f;
}

// Cones of chunks that say where they point.
void set_cones(const MeasuredRays& measured, BundleShape& shape) {
  const glm::mat3 to_local = glm::transpose(shape.frame);
  int i = 0;
  for (; i < measured.cone_count(); ++i) {
    const int first = i * kRaysPerCone, last = first + kRaysPerCone;
    const glm::vec3 axis = unit_or_z(measured.sum(first, last, shape.rays));
    set_cone(shape.cones, i, to_local * axis, measured.least_cosine(first, last, axis, shape.rays));
  }
  // Vectors of cones are loaded whole.
  for (; i % kRaysPerCone != 0; ++i) set_cone(shape.cones, i, glm::vec3(0, 0, 1), -1);
}

void make_bundle_shape(const ReceiverRays& rays, const OcclusionMask& left, BundleShape& shape) {
  shape.rays = OcclusionMask();
  const MeasuredRays measured(rays, left);
  if (measured.is_empty()) return;
  shape.radius = measured.radius();
  shape.rays = measured.long_rays();
  const int count = measured.cone_count() * kRaysPerCone;
  glm::vec3 middle = measured.middle();
  bool is_narrow = measured.is_narrow_box();
  if (!is_narrow) {
    middle = unit_or_z(measured.sum(0, count, shape.rays));
    is_narrow = measured.least_cosine(0, count, middle, shape.rays) - kRounding > kNarrow;
  }
  shape.frame = frame_around(middle);
  shape.up = is_narrow ? middle : glm::vec3(0);
  PatternCones& cones = shape.cones;
  cones.is_bundle = is_narrow;
  cones.least = measured.least();
  cones.most = measured.most();
  if (!is_narrow || cones.are_of_use(count)) set_cones(measured, shape);
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
