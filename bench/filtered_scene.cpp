#include "bench/filtered_scene.h"

#include <stdexcept>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace lkao::bench {

FilteredScene::FilteredScene(const scene::Mesh& mesh, const std::string& config)
    : device_(rtcNewDevice(config.empty() ? nullptr : config.c_str())),
      scene_(rtcNewScene(device_.get())),
      holed_(std::make_unique<Holed>(Holed{mesh.holes, {}})) {
  std::vector<std::uint32_t> whole;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    (mesh.holes->numbers[i] == scene::kWhole ? whole : holed_->primitives).push_back(i);
  }
  rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_HIGH);
  attach(mesh, whole, false);
  attach(mesh, holed_->primitives, true);
  rtcCommitScene(scene_.get());
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) throw std::runtime_error("Embree cannot build the scene");
}

void FilteredScene::attach(const scene::Mesh& mesh, const std::vector<std::uint32_t>& primitives, bool has_holes) {
  const scene::embree::Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  auto* const positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
      geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.positions.size()));
  auto* const triangles = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
      geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), primitives.size()));
  if (positions == nullptr || triangles == nullptr) throw std::runtime_error("Embree cannot build the scene");
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) positions[i] = mesh.positions[i];
  for (std::size_t i = 0; i < primitives.size(); ++i) triangles[i] = mesh.triangles[primitives[i]];
  if (has_holes) {
    rtcSetGeometryUserData(geometry.get(), holed_.get());
    rtcSetGeometryOccludedFilterFunction(geometry.get(), filter);
  }
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometry(scene_.get(), geometry.get());
}

void FilteredScene::filter(const RTCFilterFunctionNArguments* arguments) {
  const auto& holed = *static_cast<const Holed*>(arguments->geometryUserPtr);
  const unsigned count = arguments->N;
  for (unsigned lane = 0; lane < count; ++lane) {
    if (arguments->valid[lane] == 0) continue;
    const std::uint32_t primitive = holed.primitives[RTCHitN_primID(arguments->hit, count, lane)];
    const glm::vec2 place(RTCHitN_u(arguments->hit, count, lane), RTCHitN_v(arguments->hit, count, lane));
    if (!holed.holes->blocks(primitive, place)) arguments->valid[lane] = 0;
  }
}

}  // namespace lkao::bench
