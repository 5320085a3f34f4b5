// Occluders: a triangle mesh, and the bounding volume hierarchy that queries traverse.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include <glm/vec3.hpp>

#include "lkao/cut_outs.h"
#include "lkao/export.h"
#include "lkao/index_view.h"
#include "lkao/position_view.h"
#include "lkao/progress.h"
#include "lkao/requirements.h"

namespace lkao {

// A view of an indexed triangle mesh, in arrays of any layout; owns nothing. Positions in world space, in any unit. The
// front of a triangle is the side from which its corners run counter-clockwise. The index of a triangle in `triangles`
// is its primitive number.
//
//   TriangleMesh{positions, triangles}                                      vectors of glm::vec3 and glm::uvec3
//   TriangleMesh{{&vertices[0].x, vertices.size(), sizeof(Vertex)},         a renderer's own vertices
//                {indices.data(), indices.size() / 3}}                      and indices, of 16 or 32 bits
//   TriangleMesh{{doubles, choose_origin({doubles, glm::dvec3(0)})}, triangles}   far from zero: see
//   OccluderBvh::origin
struct TriangleMesh {
  PositionView positions;
  IndexView triangles;
};

// An axis-aligned box; empty where lower > upper.
struct Bounds {
  glm::vec3 lower;
  glm::vec3 upper;
};

// Where a hierarchy finds the corners of a triangle. Queries ask for them where a ray passes an edge so closely that
// the floats in the leaves cannot decide, one in a thousand times; by Kernel::scalar and tables each time.
enum class MeshStorage {
  // In a packed copy of its own: the mesh may go after the build.
  copy,
  // In the host's arrays, whatever their layout: the mesh is in memory once. They must stay where they are, and hold
  // what they hold, as long as the hierarchy, its copies or queries of them are in use.
  refer
};

struct BuildOptions {
  // Let the builder cut long triangles by splitting their boxes. Takes 3 to 6 times as long to build and up to a third
  // more memory. By the surface area heuristic it saves 5 to 17 % of the work in rooms and dioramas, 2 to 4 %
  // outdoors and next to nothing in scans (bench/results/build.csv).
  //
  // A refit undoes what they gain, since its boxes hold whole triangles: leave them out for what moves.
  bool spatial_splits = true;
  // Keep triangles without area, for a mesh that shall stand elsewhere (OccluderScene): there their corners are rounded
  // anew, and they close what would otherwise be a crack beside them. Where the mesh is they block nothing all the
  // same, and are counted as dropped.
  bool keep_zero_area = false;
  MeshStorage mesh_storage = MeshStorage::copy;
  // Triangles with holes. Refits keep them.
  CutOuts cut_outs = {};
};

struct RefitOptions {
  // A hierarchy whose growth (BuildReport) would be more is built anew instead. At least 1; infinity: whatever it is.
  double max_growth = 2;
};

// What the build found and made. Every triangle of the mesh is an occluder or counted as dropped.
struct BuildReport {
  std::size_t triangle_count = 0;    // in the mesh
  std::size_t occluder_count = 0;    // that can block rays
  std::size_t zero_area_count = 0;   // dropped: corners on one line, or two corners equal
  std::size_t non_finite_count = 0;  // dropped: a corner with a coordinate that is NaN or beyond 1e18
  std::size_t reference_count = 0;   // leaf entries, occluder_count plus those made by spatial splits
  std::size_t node_count = 0;
  std::size_t memory_bytes = 0;  // of the finished hierarchy, with its copy of the mesh if it has one
  double seconds = 0;            // wall-clock time of the build or refit
  // Nodes and leaves that a long ray through the bounds is expected to visit, by the surface area heuristic. 0 where
  // there is no occluder.
  double surface_area_cost = 0;
  // How much more the boxes have grown since the build than they had to, by what the triangles' own boxes have: 1 after
  // a build, usually more after a refit. An estimate of surface_area_cost over that of a hierarchy built anew; how much
  // slower queries get: bvh/README.md.
  double growth = 1;
};

namespace bvh {
struct Layout;
}

// An immutable hierarchy over the triangles of a mesh: 8 children a node, at most 4 triangles a leaf. It keeps a packed
// copy of the mesh, which may go after the build, or refers to the host's (MeshStorage). Copies of the hierarchy share
// their storage.
//
// The constructor builds in parallel, in the TBB arena of the caller; the hierarchy is the same on any number
// of threads. It throws std::invalid_argument where an index is outside `positions`, naming triangle and
// index, std::bad_alloc where memory is out, and Cancelled where `progress` stops it. A mesh without any usable
// triangle is valid and blocks nothing. A built hierarchy may be used from any number of threads.
class LKAO_API OccluderBvh {
 public:
  explicit OccluderBvh(const TriangleMesh& mesh, const BuildOptions& options = {}, const Progress& progress = {});

  // The same triangles where their corners have moved to: a hierarchy of its own, with the nodes and leaves of this one
  // and new boxes. Queries answer as in one built from the new positions, bit for bit; they get slower the more the
  // motion tears apart what was together (BuildReport::growth). Takes a quarter of the time of a build without spatial
  // splits (bench/results/refit.csv).
  //
  // It is built anew instead, with the same options, where growth would be more than options.max_growth, and where a
  // triangle that the build had dropped has become usable: so refit what the last refit returned rather than the first
  // build. Triangles that have become unusable are counted as if a build had dropped them, and come back with a later
  // refit of the result.
  //
  // As many positions as at the build, in any layout and with any origin; with MeshStorage::refer the result refers to
  // them, and to the triangles of the build. This hierarchy stays as it is and may be in use meanwhile, unless it
  // refers to positions that have been overwritten. Threads as of the constructor. Throws std::invalid_argument where
  // the number of positions is another or max_growth less than 1, std::bad_alloc, and Cancelled where `progress`, which
  // counts leaves, stops it; a build that follows counts anew.
  OccluderBvh refitted(const PositionView& positions, const RefitOptions& options = {},
                       const Progress& progress = {}) const;

  const BuildReport& report() const;
  // Of all occluders; lower = +infinity, upper = -infinity where there is none.
  const Bounds& bounds() const;
  // What the mesh's positions had taken away (PositionView): receivers must be given less it, as
  // glm::vec3(position - origin()), and what comes back is less it too. Zero for a mesh of floats.
  const glm::dvec3& origin() const;
  // For the kernels of this library.
  const bvh::Layout& layout() const { return *layout_; }

 private:
  struct Finished {};
  OccluderBvh(Finished, std::shared_ptr<const bvh::Layout> layout) : layout_(std::move(layout)) {}

  std::shared_ptr<const bvh::Layout> layout_;
};

}  // namespace lkao
