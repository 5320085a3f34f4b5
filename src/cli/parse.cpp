#include "cli/parse.h"

#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "lkao/sample_pattern.h"
#include "method/read_number.h"

namespace lkao::cli {
namespace {

using method::read_number;

[[noreturn]] void reject(std::string_view expected, const std::string& text) {
  throw std::invalid_argument(fmt::format("expected {}, got '{}'", expected, text));
}

std::optional<double> read_finite(std::string_view text) {
  const std::optional<double> number = read_number<double>(text);
  const bool fits = number && std::abs(*number) <= double{std::numeric_limits<float>::max()};  // false for NaN
  return fits ? number : std::nullopt;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t end; (end = text.find(separator)) != std::string_view::npos; text.remove_prefix(end + 1)) {
    parts.push_back(text.substr(0, end));
  }
  parts.push_back(text);
  return parts;
}

}  // namespace

double parse_number(const std::string& text) {
  const std::optional<double> number = read_finite(text);
  if (!number) reject("a finite number", text);
  return *number;
}

double parse_positive_number(const std::string& text) {
  const std::optional<double> number = read_finite(text);
  if (!number || !(static_cast<float>(*number) > 0)) reject("a finite number above 0", text);
  return *number;
}

double parse_non_negative_number(const std::string& text) {
  const std::optional<double> number = read_finite(text);
  if (!number || *number < 0) reject("a finite number of at least 0", text);
  return *number;
}

float parse_field_of_view(const std::string& text) {
  const std::optional<double> degrees = read_finite(text);
  const float value = degrees ? static_cast<float>(*degrees) : 0;
  if (!(value > 0 && value < 180)) reject("degrees above 0 and below 180", text);
  return value;
}

int parse_integer(const std::string& text, int least, int most) {
  const std::optional<int> number = read_number<int>(text);
  if (!number || *number < least || *number > most) {
    reject(fmt::format("a whole number from {} to {}", least, most), text);
  }
  return *number;
}

std::uint64_t parse_seed(const std::string& text) {
  const std::optional<std::uint64_t> number = read_number<std::uint64_t>(text);
  if (!number) reject("a whole number from 0 to 2^64 - 1", text);
  return *number;
}

int parse_ray_count(const std::string& text) { return parse_integer(text, kMinRayCount, kMaxRayCount); }

glm::vec3 parse_vector(const std::string& text) { return glm::vec3(parse_position(text)); }

glm::dvec3 parse_position(const std::string& text) {
  constexpr std::string_view kExpected = "three finite numbers x,y,z";
  const std::vector<std::string_view> parts = split(text, ',');
  if (parts.size() != 3) reject(kExpected, text);
  glm::dvec3 position{0};
  for (int axis = 0; axis < 3; ++axis) {
    const std::optional<double> number = read_finite(parts[static_cast<std::size_t>(axis)]);
    if (!number) reject(kExpected, text);
    position[axis] = *number;
  }
  return position;
}

Size parse_size(const std::string& text) {
  const std::vector<std::string_view> parts = split(text, 'x');
  const std::optional<int> width = read_number<int>(parts.front());
  const std::optional<int> height = read_number<int>(parts.back());
  const auto is_side = [](std::optional<int> side) { return side && *side >= 1 && *side <= Size::kMaxSide; };
  if (parts.size() != 2 || !is_side(width) || !is_side(height)) {
    reject(fmt::format("WIDTHxHEIGHT with 1 to {} pixels a side", Size::kMaxSide), text);
  }
  if (std::int64_t{*width} * *height > Size::kMaxPixelCount) {
    reject(fmt::format("at most {} pixels in all", Size::kMaxPixelCount), text);
  }
  return {*width, *height};
}

}  // namespace lkao::cli
