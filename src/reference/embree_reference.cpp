#include "reference/embree_reference.h"

#include <cmath>
#include <new>
#include <optional>

#include "bvh/ray_parts.h"
#include "query/answer.h"
#include "query/batch.h"
#include "query/receiver_rays.h"
#include "query/shadow_answer.h"
#include "reference/cast_rays.h"
#include "reference/embree_scene.h"

namespace lkao::reference {
namespace {

using scene::embree::RayQuery;

// Up to 16 rays from one origin.
class Packet {
 public:
  explicit Packet(const glm::vec3& origin) {
    for (int lane = 0; lane < kLaneCount; ++lane) {
      rays_.org_x[lane] = origin.x;
      rays_.org_y[lane] = origin.y;
      rays_.org_z[lane] = origin.z;
      rays_.time[lane] = 0;
      rays_.mask[lane] = ~0u;
      rays_.id[lane] = 0;
      rays_.flags[lane] = 0;
    }
  }

  bool full() const { return size_ == kLaneCount; }

  // The segment counts from the share `begin` of it on.
  void add(int ray, const glm::vec3& segment, float begin) {
    numbers_[size_] = ray;
    rays_.tnear[size_] = begin;
    valid_[size_] = -1;
    rays_.dir_x[size_] = segment.x;
    rays_.dir_y[size_] = segment.y;
    rays_.dir_z[size_] = segment.z;
    rays_.tfar[size_] = 1;
    ++size_;
  }

  // Marks the blocked ones of the rays added, and empties the packet.
  void cast(RTCScene scene, RayQuery& query, OcclusionMask& blocked) {
    for (int lane = size_; lane < kLaneCount; ++lane) valid_[lane] = 0;
    find_blocked(scene, query, valid_, rays_);
    for (int lane = 0; lane < size_; ++lane) {
      if (rays_.tfar[lane] < 0) blocked.set(numbers_[lane]);
    }
    size_ = 0;
  }

 private:
  static constexpr int kLaneCount = 16;
  RTCRay16 rays_;
  alignas(64) int valid_[kLaneCount];
  int numbers_[kLaneCount];
  int size_ = 0;
};

// Where rays begin to count, as shares of them.
struct Beginnings {
  const bvh::RayParts* parts;  // null: at their origin

  bool exists(int ray) const { return parts == nullptr || parts->existing.test(ray); }
  float of(int ray) const { return parts == nullptr ? 0 : parts->begin[ray]; }
};

OcclusionMask cast_packets(const ReceiverRays& rays, const Beginnings& beginnings, RTCScene scene, RayQuery& query) {
  OcclusionMask blocked;
  Packet packet(rays.origin);
  for_each_cast_ray(rays, [&](int ray) {
    if (!beginnings.exists(ray)) return;
    packet.add(ray, rays.ray(ray), beginnings.of(ray));
    if (packet.full()) packet.cast(scene, query, blocked);
  });
  packet.cast(scene, query, blocked);
  return blocked;
}

OcclusionMask cast_single_rays(const ReceiverRays& rays, const Beginnings& beginnings, RTCScene scene,
                               RayQuery& query) {
  OcclusionMask blocked;
  const glm::vec3& origin = rays.origin;
  for_each_cast_ray(rays, [&](int number) {
    if (!beginnings.exists(number)) return;
    const glm::vec3 segment = rays.ray(number);
    const float begin = beginnings.of(number);
    RTCRay ray{origin.x, origin.y, origin.z, begin, segment.x, segment.y, segment.z, 0, 1, ~0u, 0, 0};
    find_blocked(scene, query, ray);
    if (ray.tfar < 0) blocked.set(number);
  });
  return blocked;
}

OcclusionMask cast(const ReceiverRays& rays, const Beginnings& beginnings, RTCScene scene, RayQuery& query,
                   Casting casting) {
  return casting == Casting::packets ? cast_packets(rays, beginnings, scene, query)
                                     : cast_single_rays(rays, beginnings, scene, query);
}

OcclusionMask find_blocked(const EmbreeScene& scene, const ReceiverRays& rays, const Beginnings& beginnings,
                           std::uint32_t excluded_primitive, Sidedness sidedness, Casting casting) {
  if (excluded_primitive != kNoPrimitive || sidedness == Sidedness::one_sided || scene.has_holes()) {
    FilteredRays filtered(scene, rays.origin, excluded_primitive, sidedness);
    return cast(rays, beginnings, scene.filtered(), filtered.query, casting);
  }
  RayQuery query;
  return cast(rays, beginnings, scene.plain(), query, casting);
}

// Fills `rays` with the rays that the receiver casts and finds those that are blocked.
OcclusionMask trace(const EmbreeScene& scene, Casting casting, const AmbientOcclusion& ao, const Receiver& receiver,
                    std::uint64_t index, ReceiverRays& rays) {
  ao.rays(receiver, index, rays);
  if (!rays.cast.any()) return {};
  const RayOptions& options = ao.options();
  std::optional<bvh::RayParts> parts;
  if (options.min_distance > 0) {
    const query::PatternLanes lanes(ao.pattern(), std::isinf(options.radius));
    parts = bvh::make_ray_parts(lanes.length, rays.radius, options.min_distance, rays.radius);
  }
  return find_blocked(scene, rays, {parts ? &*parts : nullptr}, receiver.excluded_primitive, options.sidedness,
                      casting);
}

}  // namespace

EmbreeReference::EmbreeReference(const scene::Mesh& mesh, const ReferenceOptions& options)
    : scene_(std::make_unique<EmbreeScene>(mesh.view(), options.robust, nullptr, mesh.holes)),
      casting_(options.casting) {}

EmbreeReference::~EmbreeReference() = default;

ReceiverOcclusion EmbreeReference::query(const AmbientOcclusion& ao, const Receiver& receiver,
                                         std::uint64_t index) const {
  ReceiverRays rays;
  const OcclusionMask blocked = trace(*scene_, casting_, ao, receiver, index, rays);
  return query::make_answer(ao.pattern(), receiver, rays, blocked);
}

QueryReport EmbreeReference::query(const AmbientOcclusion& ao, std::span<const Receiver> receivers,
                                   const QueryOutputs& outputs, std::uint64_t first_index) const {
  query::require_sizes(outputs, receivers.size(), ao.pattern().word_count());
  return query::answer_in_parts(receivers.size(), {}, [&](std::size_t first, std::size_t last) {
    ReceiverRays rays;
    QueryReport report;
    for (std::size_t k = first; k < last; ++k) {
      const OcclusionMask blocked = trace(*scene_, casting_, ao, receivers[k], first_index + k, rays);
      query::store(outputs, k, ao.pattern(), receivers[k], rays, blocked);
      query::count(report, rays, blocked);
    }
    return report;
  });
}

OcclusionMask EmbreeReference::blocked(const ReceiverRays& rays, std::uint32_t excluded_primitive,
                                       Sidedness sidedness) const {
  return find_blocked(*scene_, rays, {nullptr}, excluded_primitive, sidedness, casting_);
}

QueryReport EmbreeReference::query(const SoftShadows& shadows, std::span<const Receiver> receivers,
                                   const ShadowOutputs& outputs, std::uint64_t first_index) const {
  const int word_count = shadows.pattern().word_count();
  query::require_sizes(outputs, receivers.size(), word_count);
  return query::answer_in_parts(receivers.size(), {}, [&](std::size_t first, std::size_t last) {
    ReceiverRays rays;
    QueryReport report;
    for (std::size_t k = first; k < last; ++k) {
      const bool is_valid = shadows.rays(receivers[k], first_index + k, rays);
      const OcclusionMask mask = blocked(rays, receivers[k].excluded_primitive, shadows.options().sidedness);
      const LightVisibility answer = query::make_shadow_answer(is_valid, rays, mask);
      query::store(outputs, k, word_count, answer);
      query::count(report, rays, answer);
    }
    return report;
  });
}

}  // namespace lkao::reference
