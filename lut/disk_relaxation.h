// Points spread evenly over the unit disk.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 6.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace lkao::lut {

// Fibonacci spiral: even, regular, equal areas radially; turned by a random angle.
std::vector<glm::dvec2> spiral_points(int point_count, std::uint64_t seed);

// The paper's two steps (relax, replace each point by a random one of its Voronoi cell, relax a little more), started
// from a spiral, with the radii put back to equal areas at the end.
std::vector<glm::dvec2> relaxed_points(int point_count, std::uint64_t seed);

// Moves the points along their radii so that the k-th nearest to the centre lies at sqrt((k + 1/2) / count): as many
// points in every ring as its area asks for. Cosine-weighted directions then have an exact elevation distribution.
void restore_equal_areas(std::vector<glm::dvec2>& points);

}  // namespace lkao::lut
