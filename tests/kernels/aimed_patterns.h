// Sample patterns whose rays go where a test wants them.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "lkao/sample_pattern.h"

namespace lkao::tests {

// A ray of a pattern, in its space with the AO radius as unit: as long as the vector. Zero means a ray of no length.
// z > 0.
using PatternRay = glm::dvec3;

// Rays in the given order; as many as a pattern may have.
SamplePattern pattern_of(const std::vector<PatternRay>& rays);

// The standard pattern drawn together around its axis until no ray is farther from it than `spread` (as a sine).
SamplePattern beam(int ray_count, float spread);

// 64 rays of which only every 21st has a length: so few in each chunk that kernels take them one by one.
std::vector<PatternRay> thinned(std::vector<PatternRay> rays);

// 64 rays within the planes of the pattern's axes, of two lengths, one of them along z. Where the axes of a receiver
// are the world's, components are exactly 0.
SamplePattern cross_pattern();

}  // namespace lkao::tests
