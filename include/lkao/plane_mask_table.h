// The plane mask table: which rays of a sample pattern end beyond a plane, by one look-up.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 3.1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include <glm/vec3.hpp>

#include "lkao/export.h"
#include "lkao/plane_addressing.h"
#include "lkao/requirements.h"
#include "lkao/sample_pattern.h"

namespace lkao {

// What is kept for each cell.
enum class PlaneMasks {
  nearest,   // the mask of the plane in the middle of the cell: approximate, the paper's
  must_may,  // rays beyond every plane of the cell, and rays beyond some plane of it: exact answers
};

struct PlaneMaskTableOptions {
  // 32 to 256. The table has about resolution^3 cells, with either addressing.
  int resolution = 128;
  PlaneAddressing addressing = PlaneAddressing::slices;
  PlaneMasks masks = PlaneMasks::must_may;
  // That build the table; 0: as many as the process may run at once. Changes no bit.
  int thread_count = 0;
};

namespace lut {
class PlaneCells;
}

// Masks of all planes that can matter to a receiver at the origin of the sample pattern's space (z up), with the AO
// radius as unit of length. A plane is a unit normal n that points away from the receiver and a distance d in [0, 1];
// ray i, ending at P_i = direction(i) x length(i), is beyond it where n . P_i >= d.
//
// Two masks a cell with `must_may`, conservative by construction (proof in lut/README.md): for every plane whose normal
// is within 1e-5 radians, and whose distance within 1e-5, of a plane of the cell, must <= beyond <= may.
//
// Immutable; copies share their storage; every member may be called from any thread. Memory: about resolution^3 x
// ray_count / 8 bytes, twice that with must_may, and as much again for `directions()` where ray lengths differ.
class LKAO_API PlaneMaskTable {
 public:
  // Builds on threads of its own (options.thread_count). Throws std::invalid_argument for an option out of range.
  explicit PlaneMaskTable(SamplePattern pattern, const PlaneMaskTableOptions& options = {});

  // Cell of a plane; n is a unit vector, d is clamped to [0, 1].
  std::uint32_t cell(const glm::vec3& n, float d) const;
  // Cell of a plane through the receiver, d = 0 exactly: what edges of triangles need.
  std::uint32_t edge_cell(const glm::vec3& n) const;

  // pattern().word_count() words each. nearest() needs PlaneMasks::nearest; must() and may() need must_may.
  const std::uint64_t* nearest(std::uint32_t cell) const { return words_ + cell * stride_; }
  const std::uint64_t* must(std::uint32_t cell) const { return words_ + cell * stride_; }
  const std::uint64_t* may(std::uint32_t cell) const { return words_ + cell * stride_ + stride_ / 2; }

  // The same table for rays of full length: their directions, all at distance 1. This table itself where all rays are
  // as long as the AO radius. Node masks need it (Sec. 5, Figure 4, right).
  const PlaneMaskTable& directions() const;

  const SamplePattern& pattern() const { return pattern_; }
  const PlaneMaskTableOptions& options() const { return options_; }
  std::uint32_t cell_count() const;
  // Of the masks, those of directions() included.
  std::size_t memory_bytes() const;
  // Wall-clock time of the build.
  double build_seconds() const { return build_seconds_; }
  // For tests and studies: the geometry of the cells.
  const lut::PlaneCells& cells() const { return *cells_; }

 private:
  SamplePattern pattern_;
  PlaneMaskTableOptions options_;
  std::shared_ptr<const lut::PlaneCells> cells_;
  std::shared_ptr<const std::uint64_t[]> storage_;
  std::shared_ptr<const PlaneMaskTable> directions_;  // null where it is this table itself
  const std::uint64_t* words_ = nullptr;
  std::size_t stride_ = 0;  // words a cell
  double build_seconds_ = 0;
};

}  // namespace lkao
