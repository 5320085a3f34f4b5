// Spheres that stand for a mesh as distant occluders, and follow it where it deforms.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "lkao/occluder_bvh.h"

namespace lkao::lod {

struct SphereOptions {
  // How many; at least 1. There may be fewer, since every sphere stands for a sample of the surface at least.
  int count = 1024;
  // Rounds of Lloyd's algorithm, at least 0; it ends earlier where nothing changes.
  int iteration_count = 10;
};

// A piece of a triangle, all of it where it is no larger than half a sphere's part of the surface is long.
struct SurfaceSample {
  std::uint32_t triangle;
  std::uint32_t sphere;
  double share;       // of the triangle's area; those of a triangle add up to 1
  glm::dvec2 corner;  // its middle is a + corner.x (b - a) + corner.y (c - a)
};

// Clusters of the surface, and a sphere for each: around its centre of area, with as much surface as it has
// (4 pi r^2). A closed convex mesh then blocks, seen from all sides, as much on average as its spheres side by side
// (Cauchy: a quarter of the surface); an open sheet, which has two sides, blocks twice as much as its spheres.
//
// Based on: S. Lloyd, "Least Squares Quantization in PCM", IEEE Transactions on Information Theory 28(2), 1982, for the
// spheres of P. Shanmugam, O. Arikan, "Hardware Accelerated Ambient Occlusion Techniques on GPUs", I3D 2007, Sec. 5.
// Differs from the paper: it clusters vertices of evenly fine meshes, it seems (it does not say). Here triangles are
// cut where they are large, so that a floor of two triangles becomes many spheres.
//
// The same for any number of threads; works in the TBB arena of the caller.
class MeshSpheres {
 public:
  // Triangles without area or with a corner that is not finite or beyond 1e18 are left out. Throws
  // std::invalid_argument where an option is out of range, or an index is outside `positions`.
  MeshSpheres(const TriangleMesh& mesh, const SphereOptions& options = {});

  // Centre and radius of each sphere, for new positions of the same triangles: those of the mesh, or of one that has
  // deformed. A sphere whose triangles have lost all their area has radius 0. Time linear in the number of samples.
  // Throws std::invalid_argument where there are not as many positions as there were.
  std::vector<glm::vec4> at(const PositionView& positions) const;

  std::size_t count() const { return first_.size() - 1; }
  // Those of sphere 0 come first, and so on.
  std::span<const SurfaceSample> samples() const { return samples_; }

 private:
  std::size_t position_count_;
  std::vector<glm::uvec3> triangles_;  // of the mesh
  std::vector<SurfaceSample> samples_;
  std::vector<std::size_t> first_;  // sample of each sphere, and one more
};

}  // namespace lkao::lod
