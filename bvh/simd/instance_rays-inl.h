// Rays of several receivers in the space of an instance's mesh. Included once for each SIMD target.
#if defined(LKAO_BVH_SIMD_INSTANCE_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LKAO_BVH_SIMD_INSTANCE_RAYS_INL_H_
#undef LKAO_BVH_SIMD_INSTANCE_RAYS_INL_H_
#else
#define LKAO_BVH_SIMD_INSTANCE_RAYS_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include <hwy/highway.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "bvh/defined_triangle.h"
#include "bvh/place_rays.h"
#include "bvh/scene_query.h"
#include "bvh/simd/batch_rays-inl.h"
#include "bvh/simd/turned_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lkao::bvh::HWY_NAMESPACE {

// A ray counts only near the instance's box: it begins before the box by as much as the mesh is large, or at its
// receiver where that is nearer, and ends as far behind where it enters, or where it leaves. What is uncertain of a ray
// grows with the distance of its origin and with the length of the longest, so that far away, or where a transform
// stretches some rays a hundred times as much as others, floats would leave most rays in doubt. It does not begin at
// the box: where that is flat, all origins would lie in the triangles' planes.
//
// A triangle that the whole ray meets lies in the box, and so this part of the ray meets it; where this part meets a
// triangle for sure, the whole ray does, from the same side and farther from its origin.
class InstanceRays {
 public:
  static constexpr int kCapacity = 512;

  // One line of the cache.
  struct alignas(64) Ray {
    float inverse[3];
    float face_origins[2][3];  // as Query has them
    float origin[3];
    float towards[3];
    std::uint32_t is_open;
  };

  void begin(const SceneLayout& scene, std::uint32_t instance) {
    scene_ = &scene;
    instance_ = instance;
    placement_ = &scene.placements[instance];
    const Bounds& bounds = mesh().bounds;
    size_ = glm::distance(bounds.lower, bounds.upper);
    clear();
  }
  void clear() { count_ = receiver_count_ = 0; }

  std::uint32_t instance() const { return instance_; }
  const Layout& mesh() const { return scene_->mesh_of(*placement_); }
  int count() const { return count_; }
  Ray& ray(std::uint32_t number) { return rays_[number]; }
  const Ray& ray(std::uint32_t number) const { return rays_[number]; }
  // Its place in the batch.
  std::uint32_t place_of(std::uint32_t number) const { return places_[number]; }
  // Corners are no farther from where they count than this.
  float displacement() const { return displacement_; }

  bool has_room_for(int ray_count) const { return count_ + ray_count <= kCapacity; }

  // Its rays follow. `first_place`: of them in the batch.
  void add_receiver(const Query& query, int first_place) {
    receivers_[receiver_count_] = &query;
    first_places_[receiver_count_++] = static_cast<std::uint32_t>(first_place);
    origin_ = placement_->to_mesh * glm::dvec4(glm::dvec3(query.rays.origin), 1);
  }

  // Some rays of a chunk, which enter and leave the instance's box there, as shares of them, or nearer to their middle.
  HWY_INLINE void add(const BatchRays& batch, int chunk, std::uint32_t mask, const float* enter, const float* leave) {
    const RayTag tag;
    const hn::RebindToUnsigned<RayTag> bits_tag;
    alignas(64) float components[6][kLaneCount];
    place(batch, chunk * kLaneCount, enter, leave, components);
    const auto first = hn::Set(bits_tag, static_cast<std::uint32_t>(chunk * kLaneCount));
    int count = count_;
    for (int i = 0; i < kLaneCount; i += lane_count(tag)) {
      const std::uint32_t lanes = mask >> i & ((1u << lane_count(tag)) - 1);
      for (int row = 0; row < 6; ++row) {
        const auto bits = hn::BitCast(bits_tag, hn::Load(tag, components[row] + i));
        store_packed(bits_tag, bits, lanes, component_bits_[row] + count);
      }
      const auto places = hn::Add(hn::Load(bits_tag, kLaneNumbers + i), first);
      count += store_packed(bits_tag, places, lanes, places_ + count);
    }
    std::fill(receiver_of_ + count_, receiver_of_ + count, static_cast<std::uint8_t>(receiver_count_ - 1));
    count_ = count;
  }

  // To be called when all are there, and at least one. False where they are no matter for floats.
  bool finish() {
    glm::vec3 farthest(0), world_farthest(0);
    float longest2 = 0, world_radius = 0;
    for (int i = 0; i < count_; ++i) {
      const glm::vec3 towards = component(3, i);
      farthest = glm::max(farthest, glm::abs(component(0, i)));
      longest2 = std::max(longest2, glm::dot(towards, towards));
    }
    for (int i = 0; i < receiver_count_; ++i) {
      world_farthest = glm::max(world_farthest, glm::abs(receivers_[i]->rays.origin));
      world_radius = std::max(world_radius, receivers_[i]->radius);
    }
    // As place_rays has it.
    radius_ = 1.125f * std::sqrt(longest2);
    if (!(radius_ < 1e18f && radius_ > 1e-18f) || !(glm::length(farthest) < 1e18f)) return false;
    const glm::vec3 off = uncertainty(*placement_, world_farthest, world_radius, farthest, radius_);
    displacement_ = 1.0001f * glm::length(off);
    set_rays(1.0001f * off + 0x1p-22f * (farthest + off));
    return true;
  }

  // What triangle tests need to know of the rays, but their origins.
  Query query() const {
    Query query = query_of_instance(*scene_, *receivers_[0], instance_, receivers_[0]->open);
    query.radius = radius_;
    return query;
  }

  // By the definition: does one of these triangles of a leaf block the ray?
  HWY_NOINLINE bool is_blocked(const Leaf& leaf, std::uint32_t triangles, std::uint32_t number) const {
    const int receiver = receiver_of_[number];
    const auto ray = static_cast<int>(places_[number] - first_places_[receiver]);
    const Query query = query_of_instance(*scene_, *receivers_[receiver], instance_, receivers_[receiver]->open);
    for (; triangles != 0; triangles &= triangles - 1) {
      const std::uint32_t primitive = leaf.primitives[std::countr_zero(triangles)];
      if (DefinedTriangle(mesh(), query, primitive).blocks(ray)) return true;
    }
    return false;
  }

  // Whose rays are here: so many receivers, and of each its query, its first place in the batch and its rays.
  int receiver_count() const { return receiver_count_; }
  const Query& receiver(int i) const { return *receivers_[i]; }
  std::uint32_t first_place(int i) const { return first_places_[i]; }
  OcclusionMask rays_of(int receiver) const {
    OcclusionMask mask;
    for (int i = 0; i < count_; ++i) {
      if (receiver_of_[i] == receiver) mask.set(static_cast<int>(places_[i] - first_places_[receiver]));
    }
    return mask;
  }

 private:
  // From the world to the mesh, rounded once: origins first, then the ways to the ends.
  HWY_INLINE void place(const BatchRays& batch, int first, const float* enter, const float* leave,
                        float (&components)[6][kLaneCount]) const {
    const TurnedRays::DoubleTag double_tag;
    const TurnedRays::FloatTag tag;
    for (int i = 0; i < kLaneCount; i += lane_count(double_tag)) {
      const TurnedRays rays(placement_->to_mesh, batch.x + first + i, batch.y + first + i, batch.z + first + i);
      const auto size = rays.share_of(size_), enters = hn::Load(tag, enter + i);
      const auto ends = hn::Max(hn::Load(tag, leave + i), hn::Add(enters, size));
      const auto begin = hn::PromoteTo(double_tag, hn::Max(hn::Sub(enters, size), hn::Zero(tag)));
      const auto end = hn::PromoteTo(double_tag, hn::Min(ends, hn::Set(tag, 1.0f)));
      const auto store = [&](int row, const auto& along) HWY_ATTR {
        const auto origin = hn::MulAdd(begin, along, hn::Set(double_tag, origin_[row]));
        hn::Store(hn::DemoteTo(tag, origin), tag, components[row] + i);
        hn::Store(hn::DemoteTo(tag, hn::Mul(hn::Sub(end, begin), along)), tag, components[3 + row] + i);
      };
      store(0, rays.x());
      store(1, rays.y());
      store(2, rays.z());
    }
  }

  glm::vec3 component(int row, int i) const {
    const auto value = [&](int axis) { return std::bit_cast<float>(component_bits_[row + axis][i]); };
    return {value(0), value(1), value(2)};
  }

  // `margin`: boxes are larger by so much.
  void set_rays(const glm::vec3& margin) {
    for (int i = 0; i < count_; ++i) {
      const glm::vec3 origin = component(0, i), towards = component(3, i);
      Ray& ray = rays_[i];
      for (int axis = 0; axis < 3; ++axis) {
        ray.inverse[axis] = 1 / std::copysign(std::max(std::fabs(towards[axis]), RaySet::kShortest), towards[axis]);
        ray.face_origins[0][axis] = origin[axis] + margin[axis];
        ray.face_origins[1][axis] = origin[axis] - margin[axis];
        ray.origin[axis] = origin[axis];
        ray.towards[axis] = towards[axis];
      }
      ray.is_open = 1;
    }
  }

  static constexpr int kRoom = kCapacity + kLaneCount;

  const SceneLayout* scene_;
  const Placement* placement_;
  std::uint32_t instance_;
  float size_;         // of the mesh
  glm::dvec3 origin_;  // of the last receiver
  int count_, receiver_count_;
  float radius_, displacement_;
  const Query* receivers_[kMaxBatchReceivers];
  std::uint32_t first_places_[kMaxBatchReceivers];
  std::uint32_t component_bits_[6][kRoom];  // of floats: the origins, and the ways to the ends
  std::uint32_t places_[kRoom];
  std::uint8_t receiver_of_[kRoom];
  Ray rays_[kCapacity];
};

}  // namespace lkao::bvh::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // include guard
