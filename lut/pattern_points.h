// Points spread over the unit disk without relaxation: a lattice, a net, and chance.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace lkao::lut {

// Fibonacci spiral: even and regular, equal areas radially; turned by a random angle.
std::vector<glm::dvec2> spiral_points(int point_count, std::uint64_t seed);

// The first points of the two-dimensional Sobol sequence with Owen's scrambling, mapped to the disk.
std::vector<glm::dvec2> sobol_points(int point_count, std::uint64_t seed);

// Independent points.
std::vector<glm::dvec2> random_points(int point_count, std::uint64_t seed);

}  // namespace lkao::lut
