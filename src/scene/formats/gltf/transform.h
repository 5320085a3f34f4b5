// What a matrix does to positions, normals and fronts.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace lkao::scene::gltf {

class Transform {
 public:
  explicit Transform(const glm::dmat4& matrix);

  glm::dvec3 position(const glm::dvec3& p) const;
  // Of length one; zero where it has no direction.
  glm::vec3 normal(const glm::dvec3& n) const;
  // Whether it turns fronts into backs.
  bool is_mirroring() const { return is_mirroring_; }

 private:
  glm::dmat4 matrix_;
  glm::dmat3 for_normals_;
  bool is_identity_;
  bool is_mirroring_;
};

}  // namespace lkao::scene::gltf
