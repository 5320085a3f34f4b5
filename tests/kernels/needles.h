// Triangles so small that one ray alone can meet them, and receivers that aim a ray at them.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "lkao/lkao.h"
#include "lut/random.h"
#include "support/meshes.h"

namespace lkao::tests {

// Where a needle lies from the point that rays go to: around it, or only touching it with an edge or a corner, with
// all the rest to one side. Flat ones lie across an axis and have boxes without thickness.
enum class Touch { inside, edge, corner, flat };
inline constexpr Touch kAllTouches[] = {Touch::inside, Touch::edge, Touch::corner, Touch::flat};

// Four of them, which fill a leaf: a box of nothing else.
void add_needles(Mesh& mesh, const glm::vec3& point, float size, Touch touch, lut::RandomStream& random);

// Company for the needles, to make the hierarchy deep: `count` times four small triangles, within `reach` of 0 but
// not within `gap`.
void add_decoys(Mesh& mesh, int count, float gap, float reach, lut::RandomStream& random);

// Receivers of which each has a ray of the pattern pass through the world's origin, at `share` of its length: 64 rays
// spread over the pattern, from a random one on. There floats are finer than any distance, so that nothing is rounded
// where `share` is a power of two: needles and their boxes can be as small as one likes. Their indices are their
// places. Asks for options without a surface offset.
//
// Normals are random, or axes. With a grazing elevation > 0, the geometric normal is such that the ray is that far
// above the horizon.
struct Pin {
  float share = 1;
  bool along_axes = false;
  double elevation = 0;
};
std::vector<Receiver> pinned_receivers(const SamplePattern& pattern, const RayOptions& options, const Pin& pin,
                                       lut::RandomStream& random);

glm::vec3 random_axis(lut::RandomStream& random);

}  // namespace lkao::tests
