#include "reference/embree_scene.h"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <glm/geometric.hpp>

#include "bvh/ray_triangle.h"
#include "bvh/usable_triangle.h"
#include "lut/coordinates.h"
#include "lut/mesh_views.h"
#include "reference/embree_buffers.h"
#include "reference/embree_error.h"

namespace lkao::reference {
namespace {

bool can_block(const PositionView& positions, const glm::uvec3& triangle) {
  const glm::vec3 a = positions[triangle.x], b = positions[triangle.y], c = positions[triangle.z];
  return lut::is_in_range(a, b, c) && !bvh::has_zero_area(a, b, c);
}

// As of ReceiverRays::ray.
glm::vec3 ray_of(const RTCFilterFunctionNArguments& arguments, unsigned lane) {
  return {RTCRayN_dir_x(arguments.ray, arguments.N, lane), RTCRayN_dir_y(arguments.ray, arguments.N, lane),
          RTCRayN_dir_z(arguments.ray, arguments.N, lane)};
}

// Takes back the hits that do not count, before Embree ends the rays at them.
void filter_hits(const RTCFilterFunctionNArguments* arguments) {
  const auto& rays = *reinterpret_cast<const FilteredRays*>(arguments->context);
  for (unsigned lane = 0; lane < arguments->N; ++lane) {
    if (arguments->valid[lane] == 0) continue;
    const unsigned primitive = RTCHitN_primID(arguments->hit, arguments->N, lane);
    const bool excluded = rays.scene->primitive(primitive) == rays.excluded_primitive;
    const bool from_behind = rays.sidedness == Sidedness::one_sided && !rays.scene->faces(primitive, rays.origin);
    if (excluded || from_behind ||
        (rays.scene->has_holes() && !rays.scene->blocks(primitive, rays.origin, ray_of(*arguments, lane)))) {
      arguments->valid[lane] = 0;
    }
  }
}

}  // namespace

static_assert(std::is_standard_layout_v<FilteredRays>, "the filter casts back from the first member");

EmbreeScene::EmbreeScene(const TriangleMesh& mesh, bool robust, const char* device_config,
                         std::shared_ptr<const scene::Holes> holes)
    : device_(make_device(device_config)),
      holes_(std::move(holes)),
      flags_(robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE) {
  lut::check_indices(mesh.triangles, mesh.positions.size());
  geometry_.reset(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  check(device_.get(), "new geometry");
  add_triangles(mesh);
  plain_ = build(flags_);
}

void EmbreeScene::add_triangles(const TriangleMesh& mesh) {
  std::vector<glm::uvec3> usable;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3 triangle = mesh.triangles[i];
    if (!can_block(mesh.positions, triangle)) continue;
    usable.push_back(triangle);
    primitives_.push_back(i);
  }
  positions_ = fill_positions(geometry_.get(), mesh.positions);
  triangles_ = fill_triangles(geometry_.get(), usable);
  check(device_.get(), "buffers");
  rtcSetGeometryBuildQuality(geometry_.get(), RTC_BUILD_QUALITY_HIGH);
  rtcCommitGeometry(geometry_.get());
  check(device_.get(), "geometry");
}

scene::embree::Scene EmbreeScene::build(unsigned flags) const {
  scene::embree::Scene scene(rtcNewScene(device_.get()));
  check(device_.get(), "new scene");
  rtcSetSceneFlags(scene.get(), static_cast<RTCSceneFlags>(flags));
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
  rtcAttachGeometry(scene.get(), geometry_.get());
  rtcCommitScene(scene.get());
  check(device_.get(), "scene build");
  return scene;
}

RTCScene EmbreeScene::filtered() const {
  std::call_once(filtered_once_, [this] {
    // Isolated: while it waits for the build, this thread must not take up another receiver and come back here.
    tbb::this_task_arena::isolate([this] { filtered_ = build(flags_ | scene::embree::kFilterFlag); });
  });
  return filtered_.get();
}

bool EmbreeScene::blocks(unsigned embree_primitive, const glm::vec3& origin, const glm::vec3& ray) const {
  const glm::uvec3& triangle = triangles_[embree_primitive];
  const bvh::TriangleTest test(positions_[triangle.x], positions_[triangle.y], positions_[triangle.z], origin,
                               1.01f * glm::length(ray), Sidedness::two_sided);
  return test.can_block() && holes_->blocks(primitive(embree_primitive), glm::vec2(test.place(ray)));
}

bool EmbreeScene::faces(unsigned embree_primitive, const glm::vec3& point) const {
  const glm::uvec3& triangle = triangles_[embree_primitive];
  const glm::vec3& a = positions_[triangle.x];
  const glm::dvec3 normal = bvh::area_vector(a, positions_[triangle.y], positions_[triangle.z]);
  return glm::dot(normal, glm::dvec3(point) - glm::dvec3(a)) > 0;
}

FilteredRays::FilteredRays(const EmbreeScene& embree_scene, const glm::vec3& ray_origin, std::uint32_t excluded,
                           Sidedness occluder_sidedness)
    : query(scene::embree::Order::incoherent, filter_hits),
      scene(&embree_scene),
      origin(ray_origin),
      excluded_primitive(excluded),
      sidedness(occluder_sidedness) {}

}  // namespace lkao::reference
