// Which points are near to a surface, remembered by cells of a grid.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "lod/distance.h"

namespace lkao::lod {

// Answers Surface::is_within for one distance, and the same to the bit: most cells lie within the distance, or beyond
// it, as a whole, which their centre tells; only in the others the surface is asked about the point itself.
class NearCells {
 public:
  // Remembers about so many cells. The surface must outlive the object. `lower` is the lower corner of its box.
  NearCells(const Surface& surface, double distance, const glm::dvec3& lower, std::size_t cell_count);

  double distance() const { return distance_; }

  // Any thread.
  bool is_within(const glm::dvec3& point) const;

 private:
  enum class State : std::uint64_t { unknown, within, beyond, mixed };
  State state_of(const glm::dvec3& cell) const;

  const Surface& surface_;
  double distance_;
  double width_;      // of a cell
  glm::dvec3 lower_;  // of cell 0 0 0
  // A cell's number and state in one word: what several threads write there at a time is true each. A cell that finds
  // another's in its place takes it.
  mutable std::vector<std::atomic<std::uint64_t>> cells_;
};

}  // namespace lkao::lod
