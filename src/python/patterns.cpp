// Sample patterns, and the tables of their plane masks.
#include <cstring>

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include "lkao/occlusion_mask.h"
#include "lkao/plane_mask_table.h"
#include "lkao/sample_pattern.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/long_call.h"
#include "python/words.h"

namespace lkao::python {
namespace {

using Rho = Falloff::Function;

Falloff falloff_of(const std::string& name, std::optional<double> rate, const std::optional<Rho>& function) {
  if (function) return Falloff::custom(name, *function);
  return rate ? Falloff::exponential(*rate) : Falloff::named(name);
}

// A pattern, made without the interpreter's lock: a falloff in Python takes it when it is asked.
template <typename Make>
SamplePattern made(const Make& make) {
  const py::gil_scoped_release unlocked;
  return make();
}

SamplePattern make_pattern(const std::string& kind, int ray_count, const std::string& falloff,
                           std::optional<double> rate, const std::optional<Rho>& function, std::uint64_t seed,
                           const std::string& weighting) {
  return made([&] {
    return SamplePattern::make(pattern_kind_named(kind), ray_count, falloff_of(falloff, rate, function), seed,
                               value_of(kWeightings, weighting, "weighting"));
  });
}

SamplePattern with_falloff(const SamplePattern& pattern, const std::string& falloff, std::optional<double> rate,
                           const std::optional<Rho>& function) {
  return made([&] { return pattern.with_falloff(falloff_of(falloff, rate, function)); });
}

template <typename Number, typename Entry>
py::array copy_of(std::span<const Entry> entries, std::vector<py::ssize_t> shape) {
  return array_of<Number>(std::vector<Entry>(entries.begin(), entries.end()), std::move(shape));
}

PlaneMaskTable make_table(const SamplePattern& pattern, int resolution, const std::string& addressing,
                          const std::string& masks, int thread_count) {
  const PlaneMaskTableOptions options{.resolution = resolution,
                                      .addressing = value_of(kAddressings, addressing, "addressing"),
                                      .masks = value_of(kPlaneMasks, masks, "masks"),
                                      .thread_count = thread_count};
  const py::gil_scoped_release unlocked;
  return PlaneMaskTable(pattern, options);
}

// Those of a cell, a row each: must and may, or the nearest plane's alone.
py::array masks_of(const PlaneMaskTable& table, std::uint32_t cell) {
  if (cell >= table.cell_count()) {
    throw std::invalid_argument("cell must be below " + std::to_string(table.cell_count()) + ", not " +
                                std::to_string(cell));
  }
  const auto count = static_cast<std::size_t>(table.pattern().word_count());
  std::vector<std::uint64_t> words;
  if (table.options().masks == PlaneMasks::nearest) {
    words.assign(table.nearest(cell), table.nearest(cell) + count);
  } else {
    words.assign(table.must(cell), table.must(cell) + count);
    words.insert(words.end(), table.may(cell), table.may(cell) + count);
  }
  const auto row = static_cast<py::ssize_t>(count), rows = static_cast<py::ssize_t>(words.size() / count);
  return array_of<std::uint64_t>(std::move(words), {rows, row});
}

void bind_sample_pattern(py::module_& module) {
  py::class_<SamplePattern>(module, "SamplePattern")
      .def_static("make", &make_pattern, py::arg("kind"), py::arg("ray_count"), py::arg("falloff"), py::arg("rate"),
                  py::arg("function"), py::arg("seed"), py::arg("weighting"))
      .def_static(
          "from_disk",
          [](const py::array& points, const py::array& lengths) {
            return SamplePattern::from_disk(packed<glm::vec2, float>(points), packed<float>(lengths));
          },
          py::arg("points"), py::arg("lengths"))
      .def("with_falloff", &with_falloff, py::arg("falloff"), py::arg("rate"), py::arg("function"))
      .def_property_readonly("ray_count", &SamplePattern::ray_count)
      .def_property_readonly("word_count", &SamplePattern::word_count)
      .def_property_readonly("lowest_elevation", &SamplePattern::lowest_elevation)
      .def_property_readonly("disk",
                             [](const SamplePattern& pattern) {
                               return copy_of<float>(pattern.disk(), {pattern.ray_count(), 2});
                             })
      .def_property_readonly("directions",
                             [](const SamplePattern& pattern) {
                               return copy_of<float>(pattern.directions(), {pattern.ray_count(), 3});
                             })
      .def_property_readonly("lengths", [](const SamplePattern& pattern) {
        return copy_of<float>(pattern.lengths(), {pattern.ray_count()});
      });
}

void bind_table(py::module_& module) {
  py::class_<PlaneMaskTable>(module, "PlaneMaskTable")
      .def_static("make", &make_table, py::arg("pattern"), py::arg("resolution"), py::arg("addressing"),
                  py::arg("masks"), py::arg("thread_count"))
      .def(
          "cell",
          [](const PlaneMaskTable& table, const Triple& normal, float distance) {
            return table.cell(glm::vec3(vector_of(normal)), distance);
          },
          py::arg("normal"), py::arg("distance"))
      .def("masks_of", &masks_of, py::arg("cell"))
      .def_property_readonly("cell_count", &PlaneMaskTable::cell_count)
      .def_property_readonly("memory_bytes", &PlaneMaskTable::memory_bytes)
      .def_property_readonly("build_seconds", &PlaneMaskTable::build_seconds);
}

}  // namespace

void bind_patterns(py::module_& module) {
  bind_sample_pattern(module);
  bind_table(module);
}

}  // namespace lkao::python
