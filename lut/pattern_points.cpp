// Based on:
//   P. Shirley, K. Chiu, "A Low Distortion Map Between Disk and Square", Journal of Graphics Tools 2(3), 1997.
//   I. M. Sobol, "On the distribution of points in a cube and the approximate evaluation of integrals", USSR
//   Computational Mathematics and Mathematical Physics 7(4), 1967.
//   A. B. Owen, "Randomly Permuted (t,m,s)-Nets and (t,s)-Sequences", MCQMC 1995.
#include "lut/pattern_points.h"

#include <cmath>
#include <numbers>

#include "lut/random.h"

namespace lkao::lut {
namespace {

using std::numbers::pi;

// Square [0, 1)^2 to disk, equal areas to equal areas: squares around the middle become rings.
glm::dvec2 square_to_disk(double u, double v) {
  const double a = 2.0 * u - 1.0, b = 2.0 * v - 1.0;
  if (a == 0.0 && b == 0.0) return glm::dvec2(0.0);
  const bool is_wide = std::abs(a) > std::abs(b);
  const double radius = is_wide ? a : b;
  const double angle = is_wide ? pi / 4.0 * (b / a) : pi / 2.0 - pi / 4.0 * (a / b);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

// Coordinates of point `index` of the Sobol sequence as 32-bit fractions. The first direction numbers are the powers
// of two (the bits reversed), the second come from the polynomial x + 1.
void sobol_coordinates(std::uint32_t index, std::uint32_t& x, std::uint32_t& y) {
  x = y = 0;
  std::uint32_t direction_x = 1u << 31, direction_y = 1u << 31;
  for (; index != 0; index >>= 1) {
    if (index & 1u) x ^= direction_x, y ^= direction_y;
    direction_x >>= 1;
    direction_y ^= direction_y >> 1;
  }
}

// Owen's nested scrambling: each bit is flipped by chance that depends on all bits above it.
std::uint32_t scramble(std::uint32_t fraction, std::uint64_t seed) {
  std::uint32_t scrambled = 0;
  for (std::uint32_t bit = 0; bit < 32; ++bit) {
    // The bits above, with a one in front of them that tells how many there are.
    const std::uint64_t above = (std::uint64_t{1} << 32 | fraction) >> (32 - bit);
    const std::uint32_t flip = static_cast<std::uint32_t>(mix_bits(seed ^ mix_bits(above)) & 1u);
    scrambled = scrambled << 1 | (((fraction >> (31 - bit)) & 1u) ^ flip);
  }
  return scrambled;
}

// The middle of the smallest interval that 32 bits name.
double to_unit(std::uint32_t fraction) { return (static_cast<double>(fraction) + 0.5) * 0x1p-32; }

}  // namespace

std::vector<glm::dvec2> spiral_points(int point_count, std::uint64_t seed) {
  const double golden_angle = pi * (3.0 - std::sqrt(5.0));
  const double turn = RandomStream(seed).next_double() * 2.0 * pi;
  std::vector<glm::dvec2> points;
  for (int i = 0; i < point_count; ++i) {
    const double radius = std::sqrt((i + 0.5) / point_count);
    const double angle = turn + i * golden_angle;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return points;
}

std::vector<glm::dvec2> sobol_points(int point_count, std::uint64_t seed) {
  RandomStream random(seed);
  const std::uint64_t seed_x = random.next_bits(), seed_y = random.next_bits();
  std::vector<glm::dvec2> points;
  for (int i = 0; i < point_count; ++i) {
    std::uint32_t x, y;
    sobol_coordinates(static_cast<std::uint32_t>(i), x, y);
    points.push_back(square_to_disk(to_unit(scramble(x, seed_x)), to_unit(scramble(y, seed_y))));
  }
  return points;
}

std::vector<glm::dvec2> random_points(int point_count, std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<glm::dvec2> points;
  for (int i = 0; i < point_count; ++i) {
    const double radius = std::sqrt(random.next_double());
    const double angle = random.next_double() * 2.0 * pi;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return points;
}

}  // namespace lkao::lut
