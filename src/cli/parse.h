// Values from the text of options. Every function throws std::invalid_argument saying what it expected and what it
// got; the caller adds the option's name.
#pragma once

#include <cstdint>
#include <string>

#include <glm/vec3.hpp>

namespace lkao::cli {

// Pixels of an image. 1 to kMaxSide a side, kMaxPixelCount in all: more receivers than that would not fit in memory.
struct Size {
  static constexpr int kMaxSide = 32768;
  static constexpr std::int64_t kMaxPixelCount = std::int64_t{1} << 28;

  int width = 1024;
  int height = 768;
};

// A number that is finite, also as a float.
double parse_number(const std::string& text);
// As parse_number, and above 0, also as a float.
double parse_positive_number(const std::string& text);
// As parse_number, and >= 0.
double parse_non_negative_number(const std::string& text);
// A horizontal field of view in degrees, inside (0, 180).
float parse_field_of_view(const std::string& text);

int parse_integer(const std::string& text, int least, int most);
std::uint64_t parse_seed(const std::string& text);
// A ray count on the grid of sample patterns.
int parse_ray_count(const std::string& text);
// "x,y,z": a direction, or a place in the file's coordinates, which may be too far from zero for floats.
glm::vec3 parse_vector(const std::string& text);
glm::dvec3 parse_position(const std::string& text);
// "WxH".
Size parse_size(const std::string& text);

}  // namespace lkao::cli
