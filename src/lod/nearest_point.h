// Which of some points is nearest?
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace lkao::lod {

// A balanced k-d tree over points, which are copied. None of the libraries in use has one. Any number of threads may
// ask.
class NearestPoint {
 public:
  // At least one point, all finite.
  explicit NearestPoint(std::span<const glm::dvec3> points);

  // The index of the nearest point; of those equally near, the lowest.
  std::uint32_t to(const glm::dvec3& place) const;

 private:
  struct Node {
    glm::dvec3 point;
    std::uint32_t index;
    std::uint32_t axis;
  };
  struct Best {
    double squared_distance;
    std::uint32_t index;
  };

  void arrange(std::size_t first, std::size_t last);
  void search(std::size_t first, std::size_t last, const glm::dvec3& place, Best& best) const;

  std::vector<Node> nodes_;  // of a part [first, last) the one in the middle divides the others
};

}  // namespace lkao::lod
