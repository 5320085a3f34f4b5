// What is measured: values under names, of which columns of a CSV and of a table on the terminal are made.
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace lkao::bench {

// A text, a number, or nothing where it was not measured.
class Value {
 public:
  Value() = default;
  Value(std::string text) : value_(std::move(text)) {}
  Value(std::string_view text) : value_(std::string(text)) {}
  Value(const char* text) : value_(std::string(text)) {}
  Value(std::integral auto number) : value_(static_cast<std::int64_t>(number)) {}
  Value(std::floating_point auto number) : value_(static_cast<double>(number)) {}
  template <class Number>
  Value(const std::optional<Number>& number) {
    if (number) *this = Value(*number);
  }

  bool is_known() const { return !std::holds_alternative<std::monostate>(value_); }
  // Of a known value; `format` as of fmt: "{:.2f}".
  std::string text(const std::string& format) const;

 private:
  std::variant<std::monostate, std::string, std::int64_t, double> value_;
};

using Measurement = std::vector<std::pair<std::string, Value>>;

// Where a value goes, and in what form.
struct Column {
  std::string name = {};      // of the value
  std::string format = "{}";  // of a known value
  int width = 0;              // on the terminal; below 0: at its left edge
  std::string heading = {};   // on the terminal, where it is not the name
};
using Columns = std::vector<Column>;

// Between groups of columns on the terminal.
inline const Column kBar{.name = "|"};

// Lines of a CSV, with their ends. What is not known is empty. Throw std::logic_error for a column without a value.
std::string csv_heading(const Columns& columns);
std::string csv_row(const Columns& columns, const Measurement& measurement);

// Lines of a table on the terminal. What is not known is a dash.
std::string table_heading(const Columns& columns);
std::string table_row(const Columns& columns, const Measurement& measurement);

}  // namespace lkao::bench
