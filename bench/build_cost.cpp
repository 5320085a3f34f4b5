#include "bench/build_cost.h"

#include <atomic>
#include <ctime>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "method/stopwatch.h"
#include "reference/embree_buffers.h"
#include "scene/embree.h"

namespace lkao::bench {
namespace {

// Called by Embree with every change of the memory that it holds.
bool count_bytes(void* total, ssize_t change, bool) {
  static_cast<std::atomic<std::ptrdiff_t>*>(total)->fetch_add(change);
  return true;
}

void check(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  throw std::runtime_error(fmt::format("Embree gives error {}", static_cast<int>(error)));
}

// Both kinds of time since it was made.
class Stopwatches {
 public:
  double seconds() const { return wall_.seconds(); }
  double cpu_seconds() const { return static_cast<double>(std::clock() - cpu_start_) / CLOCKS_PER_SEC; }

 private:
  method::Stopwatch wall_;
  std::clock_t cpu_start_ = std::clock();
};

BuildCost build_embree(const TriangleMesh& mesh, RTCBuildQuality quality) {
  std::atomic<std::ptrdiff_t> bytes = 0;
  const scene::embree::Device device(rtcNewDevice(nullptr));
  if (!device) throw std::runtime_error("Embree gives no device");
  rtcSetDeviceMemoryMonitorFunction(device.get(), count_bytes, &bytes);
  const std::ptrdiff_t bytes_before = bytes;

  const Stopwatches time;
  const scene::embree::Geometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  reference::fill_positions(geometry.get(), mesh.positions);
  reference::fill_triangles(geometry.get(), mesh.triangles);
  check(device.get());
  const std::ptrdiff_t buffer_bytes = bytes - bytes_before;
  rtcSetGeometryBuildQuality(geometry.get(), quality);
  rtcCommitGeometry(geometry.get());
  const scene::embree::Scene scene(rtcNewScene(device.get()));
  rtcSetSceneBuildQuality(scene.get(), quality);
  rtcAttachGeometry(scene.get(), geometry.get());
  rtcCommitScene(scene.get());
  const double seconds = time.seconds(), cpu_seconds = time.cpu_seconds();
  check(device.get());
  return {seconds, cpu_seconds, static_cast<std::size_t>(bytes - bytes_before), static_cast<std::size_t>(buffer_bytes)};
}

BuildCost build_lkao(const TriangleMesh& mesh, const BuildOptions& options) {
  const Stopwatches time;
  OccluderBvh occluders(mesh, options);
  const double seconds = time.seconds(), cpu_seconds = time.cpu_seconds();
  const std::size_t memory_bytes = occluders.report().memory_bytes;
  const std::size_t copy_bytes = mesh.positions.size() * sizeof(glm::vec3) + mesh.triangles.size() * sizeof(glm::uvec3);
  const std::size_t mesh_bytes = options.mesh_storage == MeshStorage::copy ? copy_bytes : 0;
  return {seconds, cpu_seconds, memory_bytes, mesh_bytes, std::move(occluders)};
}

}  // namespace

BuildCost build_once(BuildMethod method, const TriangleMesh& mesh) {
  switch (method) {
    case BuildMethod::lkao:
      return build_lkao(mesh, {});
    case BuildMethod::lkao_no_splits:
      return build_lkao(mesh, {.spatial_splits = false});
    case BuildMethod::lkao_refer:
      return build_lkao(mesh, {.mesh_storage = MeshStorage::refer});
    case BuildMethod::lkao_refer_no_splits:
      return build_lkao(mesh, {.spatial_splits = false, .mesh_storage = MeshStorage::refer});
    case BuildMethod::embree_high:
      return build_embree(mesh, RTC_BUILD_QUALITY_HIGH);
    default:
      return build_embree(mesh, RTC_BUILD_QUALITY_MEDIUM);
  }
}

}  // namespace lkao::bench
