// Meshes in their own spaces, and where each stands in the world: their positions are found on the GPU.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>

#include "gpu/gl/objects.h"
#include "lkao/gl/occluders.h"

namespace lkao::gl {

class Instances {
 public:
  // As Occluders says it. Meshes that are the same arrays are kept once.
  explicit Instances(std::span<const MeshInstance> instances);

  // Of all instances, one after the other.
  std::size_t position_count() const { return position_count_; }
  // With the positions' numbers in that order. Of mirrored instances two corners are exchanged, so that fronts stay
  // fronts.
  std::vector<glm::uvec3> triangles(std::span<const MeshInstance> instances) const;

  // As many as there are instances.
  void set_transforms(std::span<const glm::mat4x3> to_world);
  // Fills the buffer, three floats for each position.
  void find_positions(ObjectName world_positions) const;

 private:
  // As transform.comp.glsl has it.
  struct Instance {
    glm::vec4 rows[3];
    GLuint first_world, first_local, padding[2];
  };

  void add_local_positions(std::span<const MeshInstance> instances);

  std::size_t position_count_ = 0;
  std::vector<Instance> instances_;
  std::vector<bool> is_mirrored_;
  Buffer local_positions_, instances_buffer_;
  ProgramObject transform_;
};

}  // namespace lkao::gl
