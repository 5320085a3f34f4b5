// From a simple mesh to a detailed one, whose occlusion the texture of the simple one shall show.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/vec3.hpp>

#include "lkao/receiver.h"
#include "scene/corner_normals.h"
#include "scene/first_hits.h"

namespace lkao::bake {

// A shell around the simple mesh, moved off it along smooth normals, so that it has no gaps at hard edges. Of each
// point of the surface a ray from the shell goes inwards, to the same distance beyond the surface, and the point stands
// for what it meets first of the detailed mesh, seen from its front.
class Cage {
 public:
  // `extrusion` is a distance, above 0. Both meshes have the same origin. Those of the normals must outlive it. Throws
  // std::invalid_argument where the extrusion is out of range, and std::runtime_error where Embree fails.
  Cage(const scene::CornerNormals& detailed, const scene::Mesh& simple, double extrusion);

  // For a point of a usable triangle of the simple mesh, by weights of its corners: the receiver on the detailed one,
  // at least `clearance` from the edges of its triangle; none where the ray meets nothing. From any thread.
  std::optional<Receiver> receiver(std::uint32_t triangle, const glm::dvec3& weights, double clearance) const;

 private:
  const scene::CornerNormals& detailed_;
  scene::CornerNormals shell_;  // of the simple mesh
  double extrusion_;
  scene::FirstHits hits_;
};

}  // namespace lkao::bake
