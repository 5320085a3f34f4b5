// Arrays of numpy as the views that the library takes, and back. What users pass is brought to these dtypes and shapes,
// and refused, in lkao/_arguments.py; what is checked here only keeps a wrong call from reading what is not there.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "lkao/index_view.h"
#include "lkao/position_view.h"

namespace lkao::python {

namespace py = pybind11;

using Triple = std::array<double, 3>;

inline glm::dvec3 vector_of(const Triple& triple) { return {triple[0], triple[1], triple[2]}; }
// A tuple of Python.
inline std::tuple<double, double, double> triple_of(const glm::dvec3& vector) { return {vector.x, vector.y, vector.z}; }

inline void require(bool is_right, const char* what) {
  if (!is_right) throw std::invalid_argument(what);
}

// The dtype exactly, in the machine's byte order.
template <typename Number>
bool holds(const py::array& array) {
  return py::isinstance<py::array_t<Number>>(array);
}

// Three numbers a row, float32 or float64, at any strides. Keeps the array.
class Rows {
 public:
  explicit Rows(py::array array) : array_(std::move(array)), are_doubles_(holds<double>(array_)) {
    require(are_doubles_ || holds<float>(array_), "rows must be float32 or float64");
    require(array_.ndim() == 2 && array_.shape(1) == 3, "rows must have the shape (n, 3)");
    first_ = static_cast<const std::byte*>(array_.data());
    stride_ = array_.strides(0);
    inner_stride_ = array_.strides(1);
  }

  std::size_t size() const { return static_cast<std::size_t>(array_.shape(0)); }
  const py::array& array() const { return array_; }
  glm::dvec3 operator[](std::size_t i) const {
    return are_doubles_ ? glm::dvec3(read<double>(i)) : glm::dvec3(read<float>(i));
  }

 private:
  template <typename Number>
  glm::vec<3, Number> read(std::size_t i) const {
    const std::byte* const row = first_ + static_cast<std::ptrdiff_t>(i) * stride_;
    Number numbers[3];
    for (std::ptrdiff_t k = 0; k < 3; ++k) std::memcpy(&numbers[k], row + k * inner_stride_, sizeof(Number));
    return {numbers[0], numbers[1], numbers[2]};
  }

  py::array array_;
  bool are_doubles_;
  const std::byte* first_;
  std::ptrdiff_t stride_, inner_stride_;
};

// One uint32 a receiver, or none at all. Keeps the array.
class Numbers {
 public:
  Numbers(std::optional<py::array> array, std::size_t count) {
    if (!array) return;
    require(holds<std::uint32_t>(*array) && array->ndim() == 1, "numbers must be uint32, of one dimension");
    require(static_cast<std::size_t>(array->shape(0)) == count, "there must be as many numbers as receivers");
    array_ = std::move(*array);
    first_ = static_cast<const std::byte*>(array_.data());
    stride_ = array_.strides(0);
  }

  explicit operator bool() const { return first_ != nullptr; }
  std::uint32_t operator[](std::size_t i) const {
    std::uint32_t number;
    std::memcpy(&number, first_ + static_cast<std::ptrdiff_t>(i) * stride_, sizeof(number));
    return number;
  }

 private:
  py::array array_;
  const std::byte* first_ = nullptr;
  std::ptrdiff_t stride_ = 0;
};

// The bytes from a row to the next. Of fewer than two rows numpy's strides may be anything.
inline std::size_t row_stride(const py::array& array, std::size_t item_size) {
  require(array.ndim() == 2 && array.shape(1) == 3, "an array must have the shape (n, 3)");
  if (array.shape(0) < 2) return 0;
  const py::ssize_t stride = array.strides(0), item = static_cast<py::ssize_t>(item_size);
  require(array.strides(1) == item && stride >= 3 * item, "the numbers of a row must lie side by side");
  return static_cast<std::size_t>(stride);
}

// Copies nothing. The origin is for doubles alone.
inline PositionView positions_of(const py::array& array, const Triple& origin) {
  const auto count = static_cast<std::size_t>(array.ndim() == 2 ? array.shape(0) : 0);
  if (holds<float>(array)) {
    return {static_cast<const float*>(array.data()), count, row_stride(array, sizeof(float))};
  }
  require(holds<double>(array), "positions must be float32 or float64");
  return {static_cast<const double*>(array.data()), count, vector_of(origin), row_stride(array, sizeof(double))};
}

// Copies nothing.
inline IndexView triangles_of(const py::array& array) {
  const auto count = static_cast<std::size_t>(array.ndim() == 2 ? array.shape(0) : 0);
  if (holds<std::uint16_t>(array)) {
    return {static_cast<const std::uint16_t*>(array.data()), count, row_stride(array, sizeof(std::uint16_t))};
  }
  if (holds<std::int32_t>(array)) {
    return {static_cast<const std::int32_t*>(array.data()), count, row_stride(array, sizeof(std::int32_t))};
  }
  require(holds<std::uint32_t>(array), "triangles must be uint16, uint32 or int32");
  return {static_cast<const std::uint32_t*>(array.data()), count, row_stride(array, sizeof(std::uint32_t))};
}

// A packed array of so many entries, to be read.
template <typename Entry, typename Number = Entry>
std::span<const Entry> packed(const py::array& array) {
  static_assert(sizeof(Entry) % sizeof(Number) == 0);
  constexpr std::size_t kWidth = sizeof(Entry) / sizeof(Number);
  require((py::isinstance<py::array_t<Number, py::array::c_style>>(array)), "an array must be packed");
  const auto count = static_cast<std::size_t>(array.size());
  require(count % kWidth == 0, "an array must be of whole entries");
  return {reinterpret_cast<const Entry*>(array.data()), count / kWidth};
}

// ... to be written: empty where there is none.
template <typename Entry, typename Number = Entry>
std::span<Entry> output(std::optional<py::array>& array, std::size_t count) {
  if (!array) return {};
  const std::span<const Entry> entries = packed<Entry, Number>(*array);
  require(entries.size() == count, "an output must have an entry for every receiver");
  return {reinterpret_cast<Entry*>(array->mutable_data()), count};  // throws where it is read-only
}

// An array of numpy that owns what was a vector; `width` numbers a row, 1: of one dimension.
template <typename Number, typename Entry>
py::array array_of(std::vector<Entry> entries, std::vector<py::ssize_t> shape) {
  auto kept = std::make_unique<std::vector<Entry>>(std::move(entries));
  const Number* const first = reinterpret_cast<const Number*>(kept->data());
  const py::capsule owner(kept.get(), [](void* vector) { delete static_cast<std::vector<Entry>*>(vector); });
  kept.release();
  return py::array_t<Number>(std::move(shape), first, owner);
}
inline py::array rows_of(std::vector<glm::vec3> rows) {
  const auto count = static_cast<py::ssize_t>(rows.size());
  return array_of<float>(std::move(rows), {count, 3});
}
inline py::array rows_of(std::vector<glm::uvec3> rows) {
  const auto count = static_cast<py::ssize_t>(rows.size());
  return array_of<std::uint32_t>(std::move(rows), {count, 3});
}
template <typename Number>
py::array row_of(std::vector<Number> numbers) {
  const auto count = static_cast<py::ssize_t>(numbers.size());
  return array_of<Number>(std::move(numbers), {count});
}

}  // namespace lkao::python
