#include "scene/first_hits.h"

#include <algorithm>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "scene/facet.h"
#include "scene/holes.h"

namespace lkao::scene {
namespace {

using embree::Scene;

// The triangles that can be seen: with a plane, and of finite corners. The others keep their numbers.
std::vector<glm::uvec3> visible_triangles(const Mesh& mesh) {
  std::vector<glm::uvec3> triangles = mesh.triangles;
  for (glm::uvec3& triangle : triangles) {
    if (!Facet(mesh, triangle).is_usable()) triangle = glm::uvec3(triangle.x);
  }
  return triangles;
}

// What casts a ray among triangles with holes.
struct SeeingRay {
  explicit SeeingRay(const Holes& of_mesh);

  embree::RayQuery query;  // first: Embree hands its address to the filter
  const Holes* holes;
};

// Takes back the hits of holes, before Embree ends the ray at them.
void look_through_holes(const RTCFilterFunctionNArguments* arguments) {
  const auto& ray = *reinterpret_cast<const SeeingRay*>(arguments->context);
  const unsigned count = arguments->N;
  for (unsigned lane = 0; lane < count; ++lane) {
    if (arguments->valid[lane] == 0) continue;
    const glm::dvec2 place(RTCHitN_u(arguments->hit, count, lane), RTCHitN_v(arguments->hit, count, lane));
    const unsigned triangle = RTCHitN_primID(arguments->hit, count, lane);
    if (!ray.holes->is_seen(triangle, place)) arguments->valid[lane] = 0;
  }
}

SeeingRay::SeeingRay(const Holes& of_mesh) : query(embree::Order::incoherent, look_through_holes), holes(&of_mesh) {}

static_assert(std::is_standard_layout_v<SeeingRay>, "the filter casts back from the first member");

Scene make_scene(RTCDevice device, const Mesh& mesh, const std::vector<glm::uvec3>& triangles) {
  Scene scene(rtcNewScene(device));
  const unsigned filter_flag = mesh.holes ? embree::kFilterFlag : RTC_SCENE_FLAG_NONE;
  rtcSetSceneFlags(scene.get(), static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | filter_flag));
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  // Copied, as Embree reads 4 bytes past the end of a shared buffer.
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                           std::max<std::size_t>(mesh.positions.size(), 1));
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3),
                                          std::max<std::size_t>(triangles.size(), 1));
  if (vertices == nullptr || indices == nullptr) {
    rtcReleaseGeometry(geometry);
    throw std::runtime_error("first hits: out of memory");
  }
  std::fill_n(static_cast<glm::uvec3*>(indices), std::max<std::size_t>(triangles.size(), 1), glm::uvec3(0));
  std::copy(mesh.positions.begin(), mesh.positions.end(), static_cast<glm::vec3*>(vertices));
  std::copy(triangles.begin(), triangles.end(), static_cast<glm::uvec3*>(indices));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcJoinCommitScene(scene.get());
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE) {
    throw std::runtime_error(fmt::format("first hits: Embree error {}", static_cast<int>(error)));
  }
  return scene;
}

}  // namespace

FirstHits::FirstHits(const Mesh& mesh) : device_(rtcNewDevice(nullptr)), holes_(mesh.holes) {
  if (!device_) throw std::runtime_error("first hits: Embree cannot make a device");
  scene_ = make_scene(device_.get(), mesh, visible_triangles(mesh));
}

std::optional<SurfaceHit> FirstHits::cast(const glm::dvec3& origin, const glm::dvec3& direction, double near,
                                          double far) const {
  RTCRayHit query{};
  query.ray.tnear = static_cast<float>(near);
  query.ray.org_x = static_cast<float>(origin.x);
  query.ray.org_y = static_cast<float>(origin.y);
  query.ray.org_z = static_cast<float>(origin.z);
  query.ray.dir_x = static_cast<float>(direction.x);
  query.ray.dir_y = static_cast<float>(direction.y);
  query.ray.dir_z = static_cast<float>(direction.z);
  query.ray.tfar = static_cast<float>(far);
  query.ray.mask = ~0u;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  if (holes_) {
    SeeingRay ray(*holes_);
    embree::intersect(scene_.get(), ray.query, query);
  } else {
    embree::RayQuery ray;
    embree::intersect(scene_.get(), ray, query);
  }
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  // Robust hits may lie a rounding error outside; the surface ends at its edges.
  const double u = std::clamp(static_cast<double>(query.hit.u), 0.0, 1.0);
  const double v = std::clamp(static_cast<double>(query.hit.v), 0.0, 1.0 - u);
  return SurfaceHit{query.hit.primID, {1 - u - v, u, v}};
}

}  // namespace lkao::scene
