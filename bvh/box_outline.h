// A box as a receiver outside sees it: the edges of its outline, and the faces that are turned to the receiver.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "lkao/occluder_bvh.h"

namespace lkao::bvh {

// Planes that every ray which meets the box lies beyond. None where the origin is inside the box.
class BoxOutline {
 public:
  BoxOutline(const Bounds& box, const glm::vec3& origin)
      : lower_(glm::dvec3(box.lower) - glm::dvec3(origin)), upper_(glm::dvec3(box.upper) - glm::dvec3(origin)) {
    for (int axis = 0; axis < 3; ++axis) {
      sees_lower_[axis] = lower_[axis] > 0;
      sees_upper_[axis] = upper_[axis] < 0;
    }
    // An edge belongs to the outline where just one of its two faces is seen.
    for (int along = 0; along < 3; ++along) {
      for (int corner = 0; corner < 4; ++corner) add_edge_if_outline(along, (corner & 1) != 0, (corner & 2) != 0);
    }
  }

  // Normals of the planes through the origin and an edge of the outline, pointing to the side of the box.
  int edge_count() const { return edge_count_; }
  const glm::dvec3& edge(int i) const { return edges_[i]; }

  // The faces seen: the plane face_normal . x = face_distance. At most one a direction.
  bool sees_face(int axis) const { return sees_lower_[axis] || sees_upper_[axis]; }
  glm::dvec3 face_normal(int axis) const {
    glm::dvec3 normal(0);
    normal[axis] = sees_lower_[axis] ? 1 : -1;
    return normal;
  }
  double face_distance(int axis) const { return sees_lower_[axis] ? lower_[axis] : -upper_[axis]; }

 private:
  void add_edge_if_outline(int along, bool first_is_upper, bool second_is_upper) {
    const int first = (along + 1) % 3, second = (along + 2) % 3;
    const bool sees_first = first_is_upper ? sees_upper_[first] : sees_lower_[first];
    const bool sees_second = second_is_upper ? sees_upper_[second] : sees_lower_[second];
    if (sees_first == sees_second) return;
    glm::dvec3 start = lower_;
    if (first_is_upper) start[first] = upper_[first];
    if (second_is_upper) start[second] = upper_[second];
    // The edge runs along an axis, so its plane has the normal axis x start, which has no component along the axis.
    glm::dvec3 normal(0);
    normal[first] = -start[second];
    normal[second] = start[first];
    // The box's other corners lie on one side; the corner opposite in both directions tells which.
    glm::dvec3 inner(0);
    inner[first] = first_is_upper ? lower_[first] : upper_[first];
    inner[second] = second_is_upper ? lower_[second] : upper_[second];
    const double side = glm::dot(normal, inner);
    if (side == 0) return;  // seen edge-on: no plane tells the sides apart
    edges_[edge_count_++] = side > 0 ? normal : -normal;
  }

  glm::dvec3 lower_, upper_;
  bool sees_lower_[3], sees_upper_[3];
  glm::dvec3 edges_[8];
  int edge_count_ = 0;
};

}  // namespace lkao::bvh
