// Joins vertices at equal positions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace lkao::scene {

class VertexJoiner {
 public:
  // Looks at nothing but what it adds itself.
  explicit VertexJoiner(std::vector<glm::dvec3>& positions) : positions_(positions) {}

  // The number of the vertex there, a new one where there is none. -0 equals 0. A NaN equals nothing, itself included:
  // such a vertex always gets a number of its own.
  std::uint32_t index_of(const glm::dvec3& position);

 private:
  std::size_t slot_of(const glm::dvec3& position) const;
  void grow();

  std::vector<glm::dvec3>& positions_;
  std::vector<std::uint32_t> slots_;  // numbers of vertices, where their hash or a slot behind it says
  std::size_t used_count_ = 0;
};

}  // namespace lkao::scene
