// Receivers as arrays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <pybind11/numpy.h>
#include <glm/vec3.hpp>

#include "lkao/ambient_occlusion.h"
#include "lkao/progress.h"
#include "lkao/receiver.h"
#include "python/arrays.h"

namespace lkao::python {

class Receivers {
 public:
  // Positions are less `origin` from here on.
  Receivers(py::array positions, py::array normals, std::optional<py::array> geometric_normals,
            std::optional<py::array> excluded, std::optional<py::array> instances, std::optional<py::array> groups,
            const Triple& origin);

  std::size_t size() const { return positions_.size(); }
  // Those from `first` on. Needs no lock of the interpreter.
  void get(std::size_t first, std::span<Receiver> part) const;

 private:
  Rows positions_, normals_;
  std::optional<Rows> geometric_normals_;
  Numbers excluded_, instances_, groups_;
  glm::dvec3 origin_;
};

// How many of `count` entries are made at a time of arrays: enough to keep all threads busy, and some megabytes.
inline constexpr std::size_t kPart = std::size_t{1} << 15;

// The caller's progress, to which all parts are one call. `weight`: how often the parts count each entry.
inline Progress progress_from(const Progress& progress, std::size_t first, std::size_t count, std::size_t weight = 1) {
  return [=, &progress](std::size_t done, std::size_t) { return progress(weight * first + done, weight * count); };
}

// The sum of the reports of `answer_part(first, receivers, progress)`, called for part after part.
template <typename AnswerPart>
QueryReport answer(const Receivers& receivers, const Progress& progress, const AnswerPart& answer_part,
                   std::size_t weight = 1) {
  QueryReport sum;
  std::vector<Receiver> part;
  for (std::size_t first = 0; first < receivers.size(); first += part.size()) {
    part.resize(std::min(kPart, receivers.size() - first));
    receivers.get(first, part);
    sum +=
        answer_part(first, std::span<const Receiver>(part), progress_from(progress, first, receivers.size(), weight));
  }
  return sum;
}

// Entries `first` and on of an output; none of one that is not wanted.
template <typename Entry>
std::span<Entry> part_of(std::span<Entry> output, std::size_t first, std::size_t count) {
  return output.empty() ? output : output.subspan(first, count);
}

}  // namespace lkao::python
