// Lloyd relaxation on the unit disk.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 6, and
// S. P. Lloyd, "Least squares quantization in PCM", IEEE Transactions on Information Theory 28(2), 1982.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace lkao::lut {

// Lloyd steps: every point goes to the centroid of its Voronoi cell.
void relax(std::vector<glm::dvec2>& points, int step_count);

// Moves every point by `share` of its way to a random place of its Voronoi cell; all the way for 1 ("reintroduce
// randomness", Sec. 6).
void scatter(std::vector<glm::dvec2>& points, double share, std::uint64_t seed);

// Moves the points along their radii so that the k-th nearest to the centre lies at sqrt((k + 1/2) / count): as many
// points in every ring as its area asks for. Cosine-weighted directions then have an exact elevation distribution.
// Leaves the points in the order of their radii.
void restore_equal_areas(std::vector<glm::dvec2>& points);

}  // namespace lkao::lut
