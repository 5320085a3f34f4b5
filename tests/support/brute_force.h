// Masks without a hierarchy: every ray against every triangle.
#pragma once

#include <glm/vec3.hpp>

#include "bvh/ray_parts.h"
#include "lkao/ambient_occlusion.h"

namespace lkao::tests {

// With the library's own triangle test: must equal the query bit for bit. `parts`: what of each ray counts; null: all.
OcclusionMask brute_force_mask(const TriangleMesh& mesh, const ReceiverRays& rays, const RayOptions& options,
                               std::uint32_t excluded_primitive = kNoPrimitive, const bvh::RayParts* parts = nullptr);

// A ray against a triangle as a textbook does it, in long double: T. Möller, B. Trumbore, "Fast, Minimum Storage
// Ray/Triangle Intersection", JGT 2(1), 1997. Shares nothing with TriangleTest.
bool textbook_blocks(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& origin,
                     const glm::vec3& ray, Sidedness sidedness = Sidedness::two_sided);

}  // namespace lkao::tests
