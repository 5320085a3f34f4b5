// Looking planes up in the plane mask table, for one receiver.
#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "lkao/occlusion_mask.h"
#include "lkao/plane_mask_table.h"

namespace lkao::bvh {

// The set of rays in question lies between these two. With nearest cells they are the same.
struct MaskBounds {
  OcclusionMask must;
  OcclusionMask may;
};

// Planes are given in world directions, by a normal of any length but zero that points away from the receiver; the
// frame turns them into the pattern's space. Each call takes away the rays that are not beyond a plane.
class TableLookup {
 public:
  // `frame`: where the pattern's axes go. `radius`: the AO radius.
  TableLookup(const PlaneMaskTable& table, const glm::mat3& frame, float radius)
      : table_(table),
        to_pattern_(glm::transpose(glm::dmat3(frame))),
        radius_(radius),
        word_count_(table.pattern().word_count()),
        has_bounds_(table.options().masks == PlaneMasks::must_may) {}

  // All rays are as long as the AO radius.
  bool has_full_length() const { return &table_.directions() == &table_; }
  // The table gives bounds, not an approximation.
  bool has_bounds() const { return has_bounds_; }

  // The plane normal . x = 0.
  void keep_beyond_edge(const glm::dvec3& normal, MaskBounds& bounds) const {
    const std::uint32_t cell = table_.edge_cell(to_pattern_ * glm::normalize(normal));
    keep(must(table_, cell), bounds.must);
    keep(may(table_, cell), bounds.may);
  }
  void keep_beyond_edge(const glm::dvec3& normal, OcclusionMask& mask) const {
    keep(may(table_, table_.edge_cell(to_pattern_ * glm::normalize(normal))), mask);
  }

  // The plane normal . x = distance.
  void keep_beyond(const glm::dvec3& normal, double distance, MaskBounds& bounds) const {
    const std::uint32_t cell = cell_of(normal, distance);
    keep(must(table_, cell), bounds.must);
    keep(may(table_, cell), bounds.may);
  }
  void keep_beyond(const glm::dvec3& normal, double distance, OcclusionMask& mask) const {
    keep(may(table_, cell_of(normal, distance)), mask);
  }

  // Takes away rays, of whatever length, that begin beyond the plane: where they begin to count, at the distance `near`
  // from the origin.
  void drop_beyond(const glm::dvec3& normal, double distance, double near, MaskBounds& bounds) const {
    const double length = glm::length(normal), share = distance / (length * near);
    if (share > 1) return;
    const PlaneMaskTable& directions = table_.directions();
    const std::uint32_t cell = directions.cell(to_pattern_ * (normal / length), static_cast<float>(share));
    drop(may(directions, cell), bounds.must);
    drop(must(directions, cell), bounds.may);
  }

  // Rays, of whatever length, whose angle to the axis has at least this cosine.
  void keep_towards(const glm::dvec3& axis, double cosine, OcclusionMask& mask) const {
    const PlaneMaskTable& directions = table_.directions();
    const glm::vec3 normal = to_pattern_ * glm::normalize(axis);
    keep(may(directions, directions.cell(normal, static_cast<float>(cosine))), mask);
  }

 private:
  std::uint32_t cell_of(const glm::dvec3& normal, double distance) const {
    const double length = glm::length(normal);
    return table_.cell(to_pattern_ * (normal / length), static_cast<float>(distance / (length * radius_)));
  }

  const std::uint64_t* must(const PlaneMaskTable& table, std::uint32_t cell) const {
    return has_bounds_ ? table.must(cell) : table.nearest(cell);
  }
  const std::uint64_t* may(const PlaneMaskTable& table, std::uint32_t cell) const {
    return has_bounds_ ? table.may(cell) : table.nearest(cell);
  }
  void keep(const std::uint64_t* words, OcclusionMask& mask) const {
    for (int i = 0; i < word_count_; ++i) mask.words[i] &= words[i];
  }

  void drop(const std::uint64_t* words, OcclusionMask& mask) const {
    for (int i = 0; i < word_count_; ++i) mask.words[i] &= ~words[i];
  }

  const PlaneMaskTable& table_;
  glm::dmat3 to_pattern_;
  double radius_;
  int word_count_;
  bool has_bounds_;
};

}  // namespace lkao::bvh
