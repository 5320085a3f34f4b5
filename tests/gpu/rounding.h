// Why a ray may come out differently in float: it passes an edge, or ends at a plane, within rounding.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "lkao/ambient_occlusion.h"

namespace lkao::gl::tests {

// Of the distances in play; float has 6e-8.
inline constexpr double kRounding = 2e-6;

// True where moving the ray by `share` of the distances in play (of the triangle's corners and the ray's end from the
// receiver) can decide whether the triangle blocks it: it is on the right side of all four planes or that close to
// them, and that close to one at least. The planes are those of bvh::TriangleTest, in double.
bool is_close_call(const glm::vec3& corner_a, const glm::vec3& corner_b, const glm::vec3& corner_c,
                   const glm::vec3& origin, const glm::vec3& ray, double share);

// In how many rays two sets of masks differ although no triangle is a close call. Receivers, pattern and options are
// those that made the masks.
std::uint64_t count_unexplained(const TriangleMesh& mesh, const std::vector<std::uint64_t>& a,
                                const std::vector<std::uint64_t>& b, const std::vector<Receiver>& receivers,
                                const SamplePattern& pattern, const RayOptions& options);

}  // namespace lkao::gl::tests
