#include "bench/exact_rays.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <glm/vec3.hpp>

#include "bvh/placement.h"
#include "bvh/ray_box.h"
#include "bvh/scene_layout.h"

namespace lkao::bench {
namespace {

enum class Verdict { open, undecided, blocked };  // in this order: of several triangles the largest counts

// Differences of what was float are exact, unless one is 2^40 times the other.
using Vector = glm::vec<3, long double>;

// A number and how far from it the true one may be.
struct Bounded {
  long double value, error;

  bool is_positive() const { return value > error; }
  bool is_negative() const { return value < -error; }
  bool is_sure() const { return is_positive() || is_negative(); }
};

// The volume that three vectors span: a sum of six products of three factors, each rounded twice and added four times
// at most, of 64 bits.
Bounded volume(const Vector& a, const Vector& b, const Vector& c) {
  const long double terms[] = {a.x * b.y * c.z,  a.y * b.z * c.x,  a.z * b.x * c.y,
                               -a.x * b.z * c.y, -a.y * b.x * c.z, -a.z * b.y * c.x};
  Bounded sum{0, 0};
  for (const long double term : terms) {
    sum.value += term;
    sum.error += std::fabs(term);
  }
  sum.error *= 0x1p-60L;
  return sum;
}

// The segment from the origin, without it, to `ray`, and a triangle seen from there.
Verdict decide(const Vector& ray, const Vector& a, const Vector& b, const Vector& c, Sidedness sidedness) {
  const Bounded beside[] = {volume(ray, a, b), volume(ray, b, c), volume(ray, c, a)};
  if (std::ranges::any_of(beside, &Bounded::is_positive) && std::ranges::any_of(beside, &Bounded::is_negative)) {
    return Verdict::open;
  }

  // What the triangle spans with the origin and what it spans with the ray's end have the same sign where both lie on
  // the same side of its plane.
  const Bounded before = volume(a, b, c);
  const Bounded behind = volume(a - ray, b - ray, c - ray);
  if (before.value == 0 && before.error == 0) return Verdict::open;  // all in the plane of an axis
  if (before.is_sure() && behind.is_sure() && before.is_positive() == behind.is_positive()) return Verdict::open;
  // In front of it, the origin sees a negative volume.
  if (sidedness == Sidedness::one_sided && before.is_positive()) return Verdict::open;

  const bool sure = before.is_sure() && behind.is_sure() && std::ranges::all_of(beside, &Bounded::is_sure);
  return sure ? Verdict::blocked : Verdict::undecided;
}

Verdict decide(const bvh::SceneLayout& scene, const Receiver& receiver, const ReceiverRays& rays, int ray,
               Sidedness sidedness) {
  const glm::vec3 segment = rays.ray(ray);
  const bvh::BoxRay box_ray(segment);
  const Vector along(segment), origin(rays.origin);
  Verdict verdict = Verdict::open;
  for (std::size_t i = 0; i < scene.placements.size(); ++i) {
    const bvh::Placement& placement = scene.placements[i];
    if ((placement.groups & receiver.occluder_groups) == 0 || !may_meet(box_ray, rays.origin, placement.box)) continue;
    const bvh::PackedMesh& mesh = scene.mesh_of(placement).mesh;
    for (std::uint32_t primitive = 0; primitive < mesh.triangle_view().size(); ++primitive) {
      if (primitive == receiver.excluded_primitive && i == receiver.excluded_instance) continue;
      Vector corners[3];
      for (int which = 0; which < 3; ++which) {
        corners[which] = Vector(bvh::place(placement.to_world, mesh.corner(primitive, which))) - origin;
      }
      if (placement.is_mirrored) std::swap(corners[1], corners[2]);
      verdict = std::max(verdict, decide(along, corners[0], corners[1], corners[2], sidedness));
    }
  }
  return verdict;
}

}  // namespace

Disagreement decide_exactly(const AmbientOcclusion& ao, std::span<const Receiver> receivers,
                            std::span<const std::uint64_t> first, std::span<const std::uint64_t> second) {
  const auto word_count = static_cast<std::size_t>(ao.pattern().word_count());
  Disagreement found;
  ReceiverRays rays;
  for (std::size_t k = 0; k < receivers.size(); ++k) {
    for (int ray = 0; ray < ao.pattern().ray_count(); ++ray) {
      const std::size_t word = k * word_count + static_cast<std::size_t>(ray) / 64;
      const bool by_first = (first[word] >> (ray % 64) & 1) != 0, by_second = (second[word] >> (ray % 64) & 1) != 0;
      if (by_first == by_second) continue;
      ao.rays(receivers[k], k, rays);
      const Verdict verdict = decide(ao.occluders().layout(), receivers[k], rays, ray, ao.options().sidedness);
      if (verdict == Verdict::undecided) {
        ++found.undecided;
      } else {
        ++((verdict == Verdict::blocked) == by_first ? found.second_wrong : found.first_wrong);
      }
    }
  }
  return found;
}

}  // namespace lkao::bench
