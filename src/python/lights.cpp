// What receivers see of lights and of the sky.
#include <pybind11/stl.h>

#include "lkao/sky_visibility.h"
#include "lkao/soft_shadows.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/long_call.h"
#include "python/receivers.h"
#include "python/words.h"

namespace lkao::python {
namespace {

// A disc where there is a normal, else a sphere.
SoftShadows make_shadows(const OccluderScene& scene, const Triple& position, const std::optional<Triple>& normal,
                         float radius, const SamplePattern& pattern, const std::string& sided, float rotation,
                         std::uint64_t seed, float surface_offset, const std::string& kernel) {
  const glm::vec3 centre(vector_of(position));
  const AreaLight light = normal ? AreaLight(DiscLight{centre, glm::vec3(vector_of(*normal)), radius})
                                 : AreaLight(SphereLight{centre, radius});
  const ShadowOptions options{.sidedness = value_of(kSidednesses, sided, "sided"),
                              .rotation = rotation,
                              .seed = seed,
                              .surface_offset = surface_offset};
  return SoftShadows(scene, light, pattern, options, value_of(kKernels, kernel, "kernel"));
}

QueryReport query_shadows(const SoftShadows& shadows, const Receivers& receivers, std::optional<py::array> visibility,
                          std::optional<py::array> above_horizon, std::optional<py::array> masks,
                          std::uint64_t first_index, int thread_count, const py::object& progress) {
  const std::size_t count = receivers.size(), width = static_cast<std::size_t>(shadows.pattern().word_count());
  const ShadowOutputs all{.visibility = output<float>(visibility, count),
                          .above_horizon = output<float>(above_horizon, count),
                          .mask_words = output<std::uint64_t>(masks, count * width)};
  return long_call(thread_count, progress, [&](const Progress& watch) {
    return answer(
        receivers, watch, [&](std::size_t first, std::span<const Receiver> part, const Progress& part_progress) {
          const ShadowOutputs outputs{.visibility = part_of(all.visibility, first, part.size()),
                                      .above_horizon = part_of(all.above_horizon, first, part.size()),
                                      .mask_words = part_of(all.mask_words, first * width, part.size() * width)};
          return shadows.query(part, outputs, first_index + first, part_progress);
        });
  });
}

SkyVisibility make_sky(const OccluderScene& scene, int ray_count, float radius, const std::string& sided,
                       std::uint64_t seed, float surface_offset, const std::string& kernel) {
  const SkyOptions options{.radius = radius,
                           .sidedness = value_of(kSidednesses, sided, "sided"),
                           .seed = seed,
                           .surface_offset = surface_offset};
  return SkyVisibility(scene, ray_count, options, value_of(kKernels, kernel, "kernel"));
}

QueryReport query_sky(const SkyVisibility& sky, const Receivers& receivers, std::optional<py::array> shares,
                      std::uint64_t first_index, int thread_count, const py::object& progress) {
  static_assert(sizeof(SkyShares) == 3 * sizeof(float));
  constexpr std::size_t kSides = 2;
  const std::span<SkyShares> all = output<SkyShares, float>(shares, receivers.size());
  return long_call(thread_count, progress, [&](const Progress& watch) {
    return answer(
        receivers, watch,
        [&](std::size_t first, std::span<const Receiver> part, const Progress& part_progress) {
          return sky.query(part, part_of(all, first, part.size()), first_index + first, part_progress);
        },
        kSides);
  });
}

}  // namespace

void bind_lights(py::module_& module) {
  py::class_<SoftShadows>(module, "SoftShadows")
      .def_static("make", &make_shadows, py::arg("scene"), py::arg("position"), py::arg("normal"), py::arg("radius"),
                  py::arg("pattern"), py::arg("sided"), py::arg("rotation"), py::arg("seed"), py::arg("surface_offset"),
                  py::arg("kernel"))
      .def("query", &query_shadows, py::arg("receivers"), py::arg("visibility"), py::arg("above_horizon"),
           py::arg("masks"), py::arg("first_index"), py::arg("thread_count"), py::arg("progress"));
  py::class_<SkyVisibility>(module, "SkyVisibility")
      .def_static("make", &make_sky, py::arg("scene"), py::arg("ray_count"), py::arg("radius"), py::arg("sided"),
                  py::arg("seed"), py::arg("surface_offset"), py::arg("kernel"))
      .def("query", &query_sky, py::arg("receivers"), py::arg("shares"), py::arg("first_index"),
           py::arg("thread_count"), py::arg("progress"));
}

}  // namespace lkao::python
