#include "gpu/masks/table_buffer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "gpu/gl/error.h"
#include "gpu/masks/units.h"
#include "lut/plane_cells.h"

namespace lkao::gl {
namespace {

constexpr std::size_t kTexelWords = 2;  // 64-bit words of a texel

}  // namespace

TableBuffer::TableBuffer(const PlaneMaskTable& table)
    : table_(table),
      ray_count_(table.pattern().ray_count()),
      is_cube_(table.options().addressing == PlaneAddressing::cube),
      has_bounds_(table.options().masks == PlaneMasks::must_may),
      lowest_elevation_(table.pattern().lowest_elevation()) {
  upload_masks();
  upload_pattern(table.pattern());
}

void TableBuffer::add_directions() {
  if (has_directions_ || &table_.directions() == &table_) return;
  has_directions_ = true;
  upload_masks();
}

// Each mask is filled up to whole texels; of each cell either its mask or `must`, then `may`.
std::size_t TableBuffer::words_of_cell() const {
  return kTexelWords * static_cast<std::size_t>(layer_count()) * (has_bounds_ ? 2 : 1);
}

void TableBuffer::upload_masks() {
  const std::size_t cell_count = std::size_t{table_.cell_count()} * (has_directions_ ? 2 : 1);
  const std::size_t texel_count = cell_count * words_of_cell() / kTexelWords;
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &largest);
  if (texel_count > static_cast<std::size_t>(largest)) {
    throw std::runtime_error(fmt::format(
        "the plane mask table has {} texels, and this OpenGL's buffer textures only {}: lower its resolution",
        texel_count, largest));
  }
  masks_ = make_buffer(static_cast<GLsizeiptr>(texel_count * 16), nullptr, GL_DYNAMIC_STORAGE_BIT);
  upload_cells(table_, 0);
  if (has_directions_) upload_cells(table_.directions(), table_.cell_count());
  mask_texture_ = make_buffer_texture(GL_RGBA32UI, masks_);
  check_errors("copying the plane mask table");
}

void TableBuffer::upload_cells(const PlaneMaskTable& table, std::size_t first_cell) {
  constexpr std::size_t kChunkCells = 16384;
  const auto words = static_cast<std::size_t>(table.pattern().word_count());
  const std::size_t cell_words = words_of_cell(), cell_count = table.cell_count();
  std::vector<std::uint64_t> chunk(kChunkCells * cell_words);
  for (std::size_t first = 0; first < cell_count; first += kChunkCells) {
    const std::size_t count = std::min(kChunkCells, cell_count - first);
    for (std::size_t i = 0; i < count; ++i) {
      const auto cell = static_cast<std::uint32_t>(first + i);
      std::uint64_t* target = chunk.data() + i * cell_words;
      std::copy_n(has_bounds_ ? table.must(cell) : table.nearest(cell), words, target);
      if (has_bounds_) std::copy_n(table.may(cell), words, target + cell_words / 2);
    }
    glNamedBufferSubData(masks_.name(), static_cast<GLintptr>((first_cell + first) * cell_words * 8),
                         static_cast<GLsizeiptr>(count * cell_words * 8), chunk.data());
  }
}

void TableBuffer::upload_pattern(const SamplePattern& pattern) {
  std::vector<glm::vec4> rays;
  for (std::size_t i = 0; i < pattern.directions().size(); ++i) {
    rays.emplace_back(pattern.directions()[i], pattern.lengths()[i]);
  }
  // Up to whole layers: no shader need ask how many there are.
  rays.resize(static_cast<std::size_t>(layer_count()) * 128, glm::vec4(0));
  pattern_ = make_buffer(static_cast<GLsizeiptr>(rays.size() * sizeof(glm::vec4)), rays.data(), 0);
  pattern_texture_ = make_buffer_texture(GL_RGBA32F, pattern_);
  check_errors("copying the sample pattern");
}

void TableBuffer::bind() const {
  glBindTextureUnit(LKAO_UNIT_TABLE, mask_texture_.name());
  glBindTextureUnit(LKAO_UNIT_PATTERN, pattern_texture_.name());
}

void TableBuffer::describe(MaskPassBlock& block) const {
  const lut::PlaneCells& cells = table_.cells();
  block.ray_count = ray_count_;
  block.cube_side = static_cast<std::uint32_t>(table_.options().resolution);
  block.edge_side = cells.edge_side();
  block.slice_side = cells.slice_side();
  block.slice_count = cells.slice_count();
  block.first_slice = 6 * block.edge_side * block.edge_side;
  block.slice_size = 6 * block.slice_side * block.slice_side;
  block.first_direction = has_directions_ ? table_.cell_count() : 0;
}

}  // namespace lkao::gl
