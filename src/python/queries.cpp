// Ambient occlusion of many receivers.
#include <pybind11/stl.h>

#include "lkao/ambient_occlusion.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/long_call.h"
#include "python/receivers.h"
#include "python/words.h"

namespace lkao::python {
namespace {

RayOptions make_options(float radius, const std::string& sided, float rotation, float tilt, std::uint64_t seed,
                        float surface_offset, float min_distance) {
  return {.radius = radius,
          .sidedness = value_of(kSidednesses, sided, "sided"),
          .jitter = {.rotation = rotation, .tilt = tilt},
          .seed = seed,
          .surface_offset = surface_offset,
          .min_distance = min_distance};
}

// A scene, and the distances at which it blocks.
using Level = std::tuple<OccluderScene, float, float>;

AmbientOcclusion make_query(const std::vector<Level>& levels, const SamplePattern& pattern, const RayOptions& options,
                            const std::string& kernel) {
  std::vector<OccluderLevel> ranges;
  ranges.reserve(levels.size());
  for (const auto& [scene, r_min, r_max] : levels) ranges.push_back({scene, r_min, r_max});
  return {ranges, pattern, options, value_of(kKernels, kernel, "kernel")};
}

AmbientOcclusion make_table_query(const OccluderScene& scene, const PlaneMaskTable& table, const RayOptions& options,
                                  const std::string& node_masks) {
  return {scene, table, options, value_of(kNodeMasks, node_masks, "node_masks")};
}

QueryReport query(const AmbientOcclusion& ao, const Receivers& receivers, std::optional<py::array> occlusion,
                  std::optional<py::array> bent_normals, std::optional<py::array> masks, std::uint64_t first_index,
                  int thread_count, const py::object& progress) {
  const std::size_t count = receivers.size(), width = static_cast<std::size_t>(ao.pattern().word_count());
  const QueryOutputs all{.occlusion = output<float>(occlusion, count),
                         .bent_normals = output<glm::vec3, float>(bent_normals, count),
                         .mask_words = output<std::uint64_t>(masks, count * width)};
  return long_call(thread_count, progress, [&](const Progress& watch) {
    return answer(
        receivers, watch, [&](std::size_t first, std::span<const Receiver> part, const Progress& part_progress) {
          const QueryOutputs outputs{.occlusion = part_of(all.occlusion, first, part.size()),
                                     .bent_normals = part_of(all.bent_normals, first, part.size()),
                                     .mask_words = part_of(all.mask_words, first * width, part.size() * width)};
          return ao.query(part, outputs, first_index + first, part_progress);
        });
  });
}

// Where the rays of the first receiver start, what they are, and which of them are cast.
py::tuple rays_of(const AmbientOcclusion& ao, const Receivers& receivers, std::uint64_t index) {
  std::vector<Receiver> receiver(1);
  require(receivers.size() == 1, "rays are those of one receiver");
  receivers.get(0, receiver);
  const auto rays = std::make_unique<ReceiverRays>(ao.rays(receiver[0], index));
  std::vector<glm::vec3> segments;
  segments.reserve(static_cast<std::size_t>(rays->ray_count));
  for (int i = 0; i < rays->ray_count; ++i) segments.push_back(rays->ray(i));
  std::vector<std::uint64_t> cast(rays->cast.words, rays->cast.words + rays->word_count());
  return py::make_tuple(triple_of(glm::dvec3(rays->origin)), rows_of(std::move(segments)), row_of(std::move(cast)));
}

}  // namespace

void bind_queries(py::module_& module) {
  py::class_<RayOptions>(module, "RayOptions")
      .def(py::init(&make_options), py::arg("radius"), py::arg("sided"), py::arg("rotation"), py::arg("tilt"),
           py::arg("seed"), py::arg("surface_offset"), py::arg("min_distance"));
  py::class_<AmbientOcclusion>(module, "AmbientOcclusion")
      .def_static("make", &make_query, py::arg("levels"), py::arg("pattern"), py::arg("options"), py::arg("kernel"))
      .def_static("make_with_table", &make_table_query, py::arg("scene"), py::arg("table"), py::arg("options"),
                  py::arg("node_masks"))
      .def("query", &query, py::arg("receivers"), py::arg("occlusion"), py::arg("bent_normals"), py::arg("masks"),
           py::arg("first_index"), py::arg("thread_count"), py::arg("progress"))
      .def("rays", &rays_of, py::arg("receivers"), py::arg("index"));
}

}  // namespace lkao::python
