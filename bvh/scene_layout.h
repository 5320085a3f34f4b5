// Meshes in several places, and the hierarchy over them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "bvh/layout.h"
#include "bvh/placement.h"
#include "lkao/occluder_bvh.h"

namespace lkao::bvh {

// The nodes are those of Layout, but for their leaves: each is an instance, by its number.
struct SceneLayout {
  std::vector<OccluderBvh> meshes;
  std::vector<Placement> placements;                 // by instance
  std::vector<Node, HugePageAllocator<Node>> nodes;  // the root first; none where plain() is one
  Bounds bounds;
  double built_cost = 0;  // of the nodes, when they were built; see cost_of

  const Layout& mesh_of(const Placement& placement) const { return meshes[placement.mesh].layout(); }

  // A scene of one mesh where it is needs no nodes: the mesh; null otherwise.
  const Layout* plain() const {
    return placements.size() == 1 && placements[0].is_identity() ? &mesh_of(placements[0]) : nullptr;
  }

  // Where queries begin.
  std::span<const Node> roots() const { return {&root_of(tree()), 1}; }

  // All nodes, the mesh's own where the scene is plain.
  std::span<const Node> tree() const {
    const Layout* const mesh = plain();
    return mesh != nullptr ? std::span<const Node>(mesh->nodes) : std::span<const Node>(nodes);
  }
};

// Builds the nodes over all placements that have a box, and the bounds. In parallel, the same on any number of threads.
void build_nodes(SceneLayout& scene);

// Moves the nodes' boxes to where the placements are now, and the bounds; builds anew where they have become much
// larger together than when they were built.
void update_nodes(SceneLayout& scene);

// Half the surface of all boxes in the nodes, in that of the scene's bounds: what a query's work grows with.
double cost_of(const SceneLayout& scene);

}  // namespace lkao::bvh
