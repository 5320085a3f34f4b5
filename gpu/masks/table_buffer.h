// The plane mask table and its sample pattern on the GPU.
#pragma once

#include <optional>

#include "gpu/gl/objects.h"
#include "gpu/masks/mask_pass_block.h"
#include "lkao/plane_mask_table.h"

namespace lkao::gl {

class TableBuffer {
 public:
  // Throws std::runtime_error where the table is larger than the driver's buffer textures.
  explicit TableBuffer(const PlaneMaskTable& table);

  // Adds the cells for rays of one length (PlaneMaskTable::directions()), if they differ and are not there yet: ranges
  // of distances need them.
  void add_directions();

  int ray_count() const { return ray_count_; }
  // 128-bit parts of a mask.
  int layer_count() const { return (ray_count_ + 127) / 128; }
  bool is_cube() const { return is_cube_; }
  bool has_bounds() const { return has_bounds_; }
  const PlaneMaskTable& table() const { return table_; }
  // In radians, of the pattern.
  float lowest_elevation() const { return lowest_elevation_; }

  void bind() const;
  // What of the block the table tells.
  void describe(MaskPassBlock& block) const;

 private:
  void upload_masks();
  void upload_cells(const PlaneMaskTable& table, std::size_t first_cell);
  // 64-bit words.
  std::size_t words_of_cell() const;
  void upload_pattern(const SamplePattern& pattern);

  PlaneMaskTable table_;
  int ray_count_ = 0;
  bool is_cube_ = false;
  bool has_bounds_ = false;
  float lowest_elevation_ = 0;
  bool has_directions_ = false;
  Buffer masks_, pattern_;
  Texture mask_texture_, pattern_texture_;
};

}  // namespace lkao::gl
