// Bundles of any rays.
#include <algorithm>

#include <pybind11/stl.h>

#include "lkao/ray_bundles.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/long_call.h"
#include "python/receivers.h"
#include "python/words.h"

namespace lkao::python {
namespace {

RayBundles make_bundles(const OccluderScene& scene, const std::string& sided, const std::string& kernel) {
  return RayBundles(scene, value_of(kSidednesses, sided, "sided"), value_of(kKernels, kernel, "kernel"));
}

// `rays`: (n, k, 3), or (k, 3) for all origins.
void blocked(const RayBundles& bundles, const py::array& origins, const py::array& rays, const Triple& origin,
             std::uint32_t excluded_primitive, std::uint32_t excluded_instance, std::optional<py::array> masks,
             std::uint64_t first_index, int thread_count, const py::object& progress) {
  const Rows points(origins);
  require(rays.ndim() >= 2, "rays must have two or three dimensions");
  const std::size_t count = points.size(), ray_count = static_cast<std::size_t>(rays.shape(rays.ndim() - 2));
  const std::span<const glm::vec3> segments = packed<glm::vec3, float>(rays);
  const std::size_t step = rays.ndim() == 3 ? ray_count : 0;
  require(segments.size() == (step == 0 ? ray_count : count * ray_count), "there must be rays for every origin");
  const std::size_t width = (ray_count + 63) / 64;
  const std::span<std::uint64_t> words = output<std::uint64_t>(masks, count * width);

  long_call(thread_count, progress, [&](const Progress& watch) {
    std::vector<RayBundle> part;
    std::vector<OcclusionMask> answers;
    for (std::size_t first = 0; first < count; first += part.size()) {
      part.resize(std::min(kPart, count - first));
      answers.resize(part.size());
      for (std::size_t k = 0; k < part.size(); ++k) {
        part[k] = {.origin = glm::vec3(points[first + k] - vector_of(origin)),
                   .rays = segments.subspan((first + k) * step, ray_count),
                   .excluded_primitive = excluded_primitive,
                   .excluded_instance = excluded_instance,
                   .index = first_index + first + k};
      }
      bundles.blocked(part, answers, progress_from(watch, first, count));
      for (std::size_t k = 0; k < part.size(); ++k) {
        std::copy_n(answers[k].words, width, words.begin() + static_cast<std::ptrdiff_t>((first + k) * width));
      }
    }
  });
}

}  // namespace

void bind_bundles(py::module_& module) {
  py::class_<RayBundles>(module, "RayBundles")
      .def_static("make", &make_bundles, py::arg("scene"), py::arg("sided"), py::arg("kernel"))
      .def("blocked", &blocked, py::arg("origins"), py::arg("rays"), py::arg("origin"), py::arg("excluded_primitive"),
           py::arg("excluded_instance"), py::arg("masks"), py::arg("first_index"), py::arg("thread_count"),
           py::arg("progress"));
}

}  // namespace lkao::python
