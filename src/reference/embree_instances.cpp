#include "reference/embree_instances.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include "bvh/placement.h"
#include "reference/embree_buffers.h"
#include "reference/embree_error.h"
#include "scene/view.h"

namespace lkao::reference {
namespace {

using scene::Mesh;
using scene::embree::Geometry;
using scene::embree::Scene;

Scene make_scene(RTCDevice device, bool robust) {
  Scene scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
  return scene;
}

Scene make_mesh_scene(RTCDevice device, const Mesh& mesh, bool robust) {
  Scene scene = make_scene(device, robust);
  const Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  rtcSetGeometryBuildQuality(geometry.get(), RTC_BUILD_QUALITY_HIGH);
  fill_positions(geometry.get(), mesh.positions);
  fill_triangles(geometry.get(), mesh.triangles);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene.get(), geometry.get());
  rtcCommitScene(scene.get());
  return scene;
}

void set_transform(RTCGeometry instance, const glm::mat4x3& to_world) {
  rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &to_world[0][0]);
  rtcCommitGeometry(instance);
}

// A ray from the camera's eye.
RTCRayHit camera_ray(const glm::vec3& origin, const glm::vec3& direction) {
  RTCRayHit ray{};
  ray.ray = {
      origin.x, origin.y, origin.z, 0, direction.x, direction.y, direction.z, 0, std::numeric_limits<float>::infinity(),
      ~0u,      0,        0};
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return ray;
}

Receiver receiver_at(const RTCHit& hit, const Mesh& mesh, const OccluderInstance& instance, const glm::dvec3& eye) {
  const glm::uvec3 triangle = mesh.triangles[hit.primID];
  glm::dvec3 corners[3];
  for (int i = 0; i < 3; ++i) corners[i] = bvh::place(instance.to_world, mesh.positions[triangle[i]]);
  const double u = std::clamp(double{hit.u}, 0.0, 1.0), v = std::clamp(double{hit.v}, 0.0, 1 - u);
  const glm::dvec3 position = (1 - u - v) * corners[0] + u * corners[1] + v * corners[2];
  const glm::dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  return {.position = position, .normal = glm::dot(normal, eye - position) < 0 ? -normal : normal};
}

}  // namespace

EmbreeInstances::EmbreeInstances(std::span<const Mesh> meshes, std::span<const OccluderInstance> instances, bool robust,
                                 const char* device_config)
    : device_(make_device(device_config)) {
  for (const Mesh& mesh : meshes) meshes_.push_back(make_mesh_scene(device_.get(), mesh, robust));
  check(device_.get(), "meshes");
  scene_ = make_scene(device_.get(), robust);
  instances_.reserve(instances.size());
  for (const OccluderInstance& instance : instances) {
    const Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(geometry.get(), meshes_[instance.mesh].get());
    set_transform(geometry.get(), instance.to_world);
    rtcAttachGeometry(scene_.get(), geometry.get());
    instances_.push_back(geometry.get());
  }
  rtcCommitScene(scene_.get());
  check(device_.get(), "instances");
}

void EmbreeInstances::move(std::span<const InstanceMove> moves) {
  for (const InstanceMove& move : moves) set_transform(instances_[move.instance], move.to_world);
  rtcCommitScene(scene_.get());
  check(device_.get(), "moving instances");
}

scene::ReceiverImage EmbreeInstances::see(std::span<const Mesh> meshes, std::span<const OccluderInstance> instances,
                                          const scene::Camera& camera, int width, int height) const {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const auto pixel_count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  scene::ReceiverImage image{width, height, {}, {}, 0};
  image.receivers.resize(pixel_count, {.position = glm::vec3(kNan)});
  image.depth.resize(pixel_count, std::numeric_limits<float>::infinity());
  const scene::View view = scene::view_of(camera);
  tbb::parallel_for(0, height, [&](int row) {
    for (int column = 0; column < width; ++column) {
      scene::embree::RayQuery query;
      RTCRayHit ray = camera_ray(view.eye, scene::pixel_direction(view, width, height, column, row));
      scene::embree::intersect(scene_.get(), query, ray);
      if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
      const OccluderInstance& instance = instances[ray.hit.instID[0]];
      const auto pixel = static_cast<std::size_t>(row * width + column);
      image.receivers[pixel] = receiver_at(ray.hit, meshes[instance.mesh], instance, view.eye);
      image.depth[pixel] = ray.ray.tfar;
    }
  });
  for (std::size_t i = 0; i < pixel_count; ++i) image.receiver_count += image.sees(i);
  return image;
}

}  // namespace lkao::reference
