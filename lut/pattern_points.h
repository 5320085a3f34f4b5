// Points spread over the unit disk without relaxation: a lattice, a net, and chance.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace lkao::lut {

// Fibonacci spiral: even and regular, equal areas radially; turned by a random angle.
std::vector<glm::dvec2> spiral_points(int point_count, std::uint64_t seed);

// The first points of the two-dimensional Sobol sequence with Owen's scrambling, mapped to the disk.
std::vector<glm::dvec2> sobol_points(int point_count, std::uint64_t seed);

// Independent points.
std::vector<glm::dvec2> random_points(int point_count, std::uint64_t seed);

// Moves a point along its radius so that points spread evenly over the disk become directions spread evenly over the
// hemisphere, once lifted. The share u = |p|^2 of the points is nearer to the centre; of even directions, the share u
// is above the height z = 1 - u (Archimedes), which is at the radius sqrt(1 - z^2) = |p| sqrt(2 - |p|^2).
inline glm::dvec2 to_uniform(const glm::dvec2& point) { return point * std::sqrt(2.0 - glm::dot(point, point)); }

}  // namespace lkao::lut
