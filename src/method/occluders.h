// What blocks rays: a scene, perhaps with levels of detail, in the forms that methods want, each made once for all.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "lkao/ambient_occlusion.h"
#include "lod/occluders.h"
#include "scene/mesh.h"

namespace lkao::method {

class Occluders {
 public:
  explicit Occluders(const scene::Mesh& mesh) : mesh_(mesh) {}
  // With those levels of the chain that are in use at this AO radius. Mesh and chain must outlive this.
  Occluders(const scene::Mesh& mesh, const lod::Chain& chain, float radius)
      : mesh_(mesh), chain_(&chain), radius_(radius) {}

  // The whole scene.
  const scene::Mesh& mesh() const { return mesh_; }

  // A hierarchy over each level, or over the scene with its holes. Built at the first call.
  const std::vector<OccluderLevel>& hierarchies();
  // That it took; 0 where nobody asked for them.
  double build_seconds() const { return build_seconds_; }

  // Holes are in hierarchies() alone, and not in levels.
  // All levels as one mesh, or the scene: with [r_min, r_max] of each triangle, or none.
  const scene::Mesh& drawn_mesh();
  std::span<const glm::vec2> drawn_ranges();

 private:
  const lod::RangedMesh& merged();

  const scene::Mesh& mesh_;
  const lod::Chain* chain_ = nullptr;
  float radius_ = 0;
  std::vector<OccluderLevel> hierarchies_;
  double build_seconds_ = 0;
  std::optional<lod::RangedMesh> merged_;
};

}  // namespace lkao::method
