#include "bench/measurement.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>

namespace lkao::bench {
namespace {

const Value& find(const Measurement& measurement, const std::string& name) {
  const auto found =
      std::find_if(measurement.begin(), measurement.end(), [&](const auto& entry) { return entry.first == name; });
  if (found == measurement.end()) throw std::logic_error(fmt::format("no value of the column '{}'", name));
  return found->second;
}

std::string text_of(const Column& column, const Measurement& measurement, const char* unknown) {
  const Value& value = find(measurement, column.name);
  return value.is_known() ? value.text(column.format) : unknown;
}

// A line of `cell(column)`, separated.
template <class Cell>
std::string line(const Columns& columns, const char* separator, const Cell& cell) {
  std::string text;
  for (const Column& column : columns) text += (&column == columns.data() ? "" : separator) + cell(column);
  return text + "\n";
}

bool is_bar(const Column& column) { return column.name == kBar.name; }

std::string padded(const Column& column, const std::string& text) {
  return column.width < 0 ? fmt::format("{:<{}}", text, -column.width) : fmt::format("{:>{}}", text, column.width);
}

}  // namespace

std::string Value::text(const std::string& format) const {
  const auto put = [&](const auto& value) { return fmt::vformat(format, fmt::make_format_args(value)); };
  if (const auto* const word = std::get_if<std::string>(&value_)) return put(*word);
  if (const auto* const count = std::get_if<std::int64_t>(&value_)) return put(*count);
  return put(std::get<double>(value_));
}

std::string csv_heading(const Columns& columns) {
  return line(columns, ",", [](const Column& column) { return column.name; });
}

std::string csv_row(const Columns& columns, const Measurement& measurement) {
  return line(columns, ",", [&](const Column& column) { return text_of(column, measurement, ""); });
}

std::string table_heading(const Columns& columns) {
  return line(columns, " ", [](const Column& column) {
    return is_bar(column) ? column.name : padded(column, column.heading.empty() ? column.name : column.heading);
  });
}

std::string table_row(const Columns& columns, const Measurement& measurement) {
  return line(columns, " ", [&](const Column& column) {
    return is_bar(column) ? column.name : padded(column, text_of(column, measurement, "-"));
  });
}

}  // namespace lkao::bench
