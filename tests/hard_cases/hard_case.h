// Cases that are hard on arithmetic: a mesh, a pattern, and receivers that ask for trouble.
#pragma once

#include <functional>
#include <vector>

#include <glm/vec3.hpp>

#include "lkao/lkao.h"
#include "lut/random.h"
#include "support/meshes.h"

namespace lkao::tests {

// Receivers that share the options of a query; their indices are their places.
struct ReceiverGroup {
  RayOptions options;
  std::vector<Receiver> receivers = {};
};

// How far rounding may carry the library, relative to the larger of the ray's length and the distance of the triangle's
// farthest corner:
// - a ray that the oracle does not block may be blocked if it passes an edge or ends within this distance of a
// triangle;
// - a ray that the oracle blocks may be open only if its origin is within this distance of the plane of the triangle
//   that blocks it. Nothing that is met from a distance is ever lost, least of all at an edge.
inline constexpr double kRoundingDistance = 1e-12;

struct HardCase {
  Mesh mesh;
  SamplePattern pattern;
  std::vector<ReceiverGroup> groups = {};
  double rounding_distance = kRoundingDistance;
};

// Lengths from nearly 0 to the radius; the 128 rays are as good as any.
SamplePattern usual_pattern();
// 64 rays within the planes of the pattern's axes, one along its normal; lengths are quarters of the radius.
SamplePattern axis_pattern();

// Of the finite positions that some triangle uses.
Bounds mesh_bounds(const Mesh& mesh);
float mesh_size(const Mesh& mesh);

// Appends a receiver that has ray `ray` pass through `target` at `share` of its length, exactly where the float
// position allows that. Takes options without a surface offset.
void aim(ReceiverGroup& group, const SamplePattern& pattern, const glm::vec3& target, const glm::vec3& normal, int ray,
         float share);

// Appends `count` receivers with random normals, by turns: anywhere near the mesh; on a corner, on an edge, on a face;
// and, without a surface offset, with a ray aimed at a corner, at a point of an edge or of a face, passing through it
// or ending there.
void add_receivers(ReceiverGroup& group, const HardCase& hard_case, int count, std::uint64_t seed);

// A group for each radius, as a share of the mesh's size, and one that is one-sided with the default offset.
void add_usual_groups(HardCase& hard_case, int count, std::uint64_t seed,
                      const std::vector<float>& radii = {1e-4f, 0.3f, 20.0f});

struct NamedCase {
  const char* name;
  std::function<HardCase()> make;
};

// All that are made here, by what is awkward: the shape of triangles, or where things lie in space.
std::vector<NamedCase> triangle_cases();
std::vector<NamedCase> space_cases();

}  // namespace lkao::tests
