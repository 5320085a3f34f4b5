// Compiled once for every SIMD target; the fastest that the processor has is chosen at run time. No fused
// multiply-adds: every target gives the same bits.
#include "query/light_rays.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <variant>

#include <glm/geometric.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "query/light_rays.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "lut/isa.h"
#include "lut/simd/mask_bits-inl.h"
#include "query/simd/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::query::HWY_NAMESPACE {
namespace {

// From points of the unit disk to points of a disc: all in its plane.
class OnDisc {
 public:
  OnDisc(const SeenLight& light, float share)
      : tangent_(splat(light.frame[0] * (light.radius * share))),
        bitangent_(splat(light.frame[1] * (light.radius * share))),
        center_(splat(light.center * share)) {}

  HWY_INLINE Vector operator()(Floats u, Floats v) const {
    const auto of = [&](Floats tangent, Floats bitangent, Floats center)
                        HWY_ATTR { return hn::Add(center, hn::Add(hn::Mul(tangent, u), hn::Mul(bitangent, v))); };
    return {of(tangent_.x, bitangent_.x, center_.x), of(tangent_.y, bitangent_.y, center_.y),
            of(tangent_.z, bitangent_.z, center_.z)};
  }

 private:
  Vector tangent_, bitangent_, center_;
};

// ... to points of a sphere. With k = 1 - the cosine of the cone's angle and q the square of a point's distance from
// the disk's centre, a direction has the cosine 1 - k q to the axis: even in solid angle, as the points are in area.
class OnSphere {
 public:
  OnSphere(const SeenLight& light, float share)
      : tangent_(splat(light.frame[0])),
        bitangent_(splat(light.frame[1])),
        axis_(splat(light.frame[2])),
        k_(hn::Set(Tag(), light.one_minus_cosine)),
        sine2_(hn::Set(Tag(), light.sine2)),
        distance_(hn::Set(Tag(), light.distance * share)),
        is_within_(light.is_within) {}

  HWY_INLINE Vector operator()(Floats u, Floats v) const {
    const Tag tag;
    const auto zero = hn::Zero(tag), one = hn::Set(tag, 1.0f), two = hn::Set(tag, 2.0f);
    const auto q = hn::Add(hn::Mul(u, u), hn::Mul(v, v)), less = hn::Mul(k_, q);
    const auto cosine = hn::Sub(one, less);
    // Rounding may take a point to the rim and beyond.
    const auto beyond = hn::Max(zero, hn::Sub(two, less));
    const auto sideways = hn::Sqrt(hn::Mul(k_, beyond)), own_sine2 = hn::Mul(less, beyond);
    const auto depth = hn::Sqrt(hn::Max(zero, hn::Sub(sine2_, own_sine2)));
    const auto length = hn::Mul(distance_, is_within_ ? hn::Add(cosine, depth) : hn::Sub(cosine, depth));
    const auto s = hn::Mul(sideways, u), t = hn::Mul(sideways, v);
    const auto of = [&](Floats tangent, Floats bitangent, Floats axis) HWY_ATTR {
      const auto direction = hn::Add(hn::Add(hn::Mul(tangent, s), hn::Mul(bitangent, t)), hn::Mul(axis, cosine));
      return hn::Mul(direction, length);
    };
    return {of(tangent_.x, bitangent_.x, axis_.x), of(tangent_.y, bitangent_.y, axis_.y),
            of(tangent_.z, bitangent_.z, axis_.z)};
  }

 private:
  Vector tangent_, bitangent_, axis_;
  Floats k_, sine2_, distance_;
  bool is_within_;
};

template <class PointOf>
HWY_INLINE void fill(const PatternLanes& disk, const PointOf& point_of, ReceiverRays& rays) {
  const Tag tag;
  constexpr int kLaneCount = static_cast<int>(hn::MaxLanes(Tag()));
  const Vector up = splat(rays.up);
  for (int first = 0; first < rays.ray_count; first += 64) {
    std::uint64_t cast = 0;
    for (int bit = 0; bit < 64; bit += kLaneCount) {
      const int ray = first + bit;
      const auto i = static_cast<std::size_t>(ray);
      Vector point = point_of(hn::LoadU(tag, &disk.x[i]), hn::LoadU(tag, &disk.y[i]));
      // Behind the last ray there are none.
      const auto exists = hn::Gt(hn::LoadU(tag, &disk.length[i]), hn::Zero(tag));
      point = {hn::IfThenElseZero(exists, point.x), hn::IfThenElseZero(exists, point.y),
               hn::IfThenElseZero(exists, point.z)};
      hn::Store(point.x, tag, rays.x + ray);
      hn::Store(point.y, tag, rays.y + ray);
      hn::Store(point.z, tag, rays.z + ray);
      cast |= lut::HWY_NAMESPACE::long_bits_of(tag, hn::Gt(dot(point, up), hn::Zero(tag))) << bit;
    }
    rays.cast.words[first / 64] = cast;
  }
}

void aim_at_light(const PatternLanes& disk, const SeenLight& light, float share, ReceiverRays& rays) {
  if (light.is_sphere) {
    fill(disk, OnSphere(light, share), rays);
  } else {
    fill(disk, OnDisc(light, share), rays);
  }
}

}  // namespace
}  // namespace lkao::query::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lkao::query {

HWY_EXPORT(aim_at_light);

void aim_at_light(const PatternLanes& disk, const SeenLight& light, float share, ReceiverRays& rays) {
  LKAO_DISPATCH(aim_at_light)(disk, light, share, rays);
}

namespace {

// From where rays are in range of every kernel.
constexpr double kFarthest = 5e17;

bool see_one(const DiscLight& light, const glm::vec3& origin, double turn, SeenLight& seen) {
  const glm::dvec3 center = glm::dvec3(light.position) - glm::dvec3(origin);
  seen.is_sphere = false;
  seen.frame = frame_around(glm::normalize(glm::dvec3(light.normal)), turn);
  seen.center = center;
  seen.distance = static_cast<float>(glm::length(center));
  seen.radius = light.radius;
  return seen.distance + light.radius < kFarthest;
}

bool see_one(const SphereLight& light, const glm::vec3& origin, double turn, SeenLight& seen) {
  const glm::dvec3 center = glm::dvec3(light.position) - glm::dvec3(origin);
  const double distance = glm::length(center), radius = static_cast<double>(light.radius);
  seen.is_sphere = true;
  seen.is_within = distance <= radius;
  // From within, lengths are in units of the radius where the centre is nearly there.
  const double unit = std::max(distance, 1e-6 * radius);
  seen.frame = frame_around(distance > 0 ? center / distance : glm::dvec3(0, 0, 1), turn);
  seen.center = center;
  seen.distance = static_cast<float>(unit);
  seen.radius = light.radius;
  const double sine2 = radius * radius / (unit * unit);
  seen.sine2 = static_cast<float>(sine2);
  seen.one_minus_cosine = seen.is_within ? 2.0f : static_cast<float>(sine2 / (1 + std::sqrt(1 - sine2)));
  return distance + radius < kFarthest;
}

}  // namespace

bool see(const AreaLight& light, const glm::vec3& origin, double turn, SeenLight& seen) {
  return std::visit([&](const auto& one) { return see_one(one, origin, turn, seen); }, light);
}

}  // namespace lkao::query
#endif
