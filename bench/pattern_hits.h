// How far rays get: first hits through Embree, for studies of what to cast rather than how.
#pragma once

#include <span>

#include <glm/vec3.hpp>

#include "lkao/lkao.h"
#include "reference/embree_scene.h"
#include "scene/mesh.h"

namespace lkao::bench {

// Usable from any number of threads.
class FirstHits {
 public:
  // Distances are shares of the AO radius. Errors as reference::EmbreeScene.
  FirstHits(const scene::Mesh& mesh, float radius);

  // Distance to the first hit of each ray from the receiver, +infinity where nothing is within the radius.
  // `frame` turns the directions into world space.
  void find(const Receiver& receiver, const glm::mat3& frame, std::span<const glm::vec3> directions,
            std::span<float> distances) const;

 private:
  reference::EmbreeScene scene_;
  float radius_;
  float surface_offset_;
};

}  // namespace lkao::bench
