#include "lkao/plane_mask_table.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "lut/isa.h"
#include "lut/parallel.h"
#include "lut/plane_cells.h"
#include "lut/plane_mask_fill.h"

namespace lkao {
namespace {

lut::RayEnds ends_of(const SamplePattern& pattern) {
  lut::RayEnds ends;
  ends.word_count = pattern.word_count();
  for (std::size_t i = 0; i < pattern.directions().size(); ++i) {
    const glm::vec3 end = pattern.directions()[i] * pattern.lengths()[i];
    ends.x.push_back(end.x);
    ends.y.push_back(end.y);
    ends.z.push_back(end.z);
    ends.length.push_back(glm::length(end));
  }
  const auto padded_count = static_cast<std::size_t>(ends.word_count) * 64;
  ends.last_word = ~std::uint64_t{0} >> (padded_count - ends.x.size());
  for (std::vector<float>* component : {&ends.x, &ends.y, &ends.z, &ends.length}) component->resize(padded_count);
  return ends;
}

std::shared_ptr<const std::uint64_t[]> fill(const lut::RayEnds& ends, const lut::PlaneCells& cells,
                                            const PlaneMaskTableOptions& options) {
  const auto mask_words = static_cast<std::size_t>(ends.word_count);
  const std::size_t stride = options.masks == PlaneMasks::must_may ? 2 * mask_words : mask_words;
  // Not made zero first: every used cell is written below, and the others are never looked up.
  std::shared_ptr<std::uint64_t[]> storage(new std::uint64_t[cells.cell_count() * stride]);
  const auto fill_part = [&](std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t cell = first; cell < last; ++cell) {
      const lut::PlaneCell geometry = cells.geometry(cell);
      if (!geometry.is_used) continue;
      std::uint64_t* words = storage.get() + cell * stride;
      if (options.masks == PlaneMasks::nearest) {
        lut::fill_nearest(ends, geometry, words);
      } else {
        lut::fill_must_may(ends, geometry, words, words + mask_words);
      }
    }
  };
  lut::for_each_part(cells.cell_count(), 4096, options.thread_count, fill_part);
  return storage;
}

bool has_full_length(const SamplePattern& pattern) {
  return std::all_of(pattern.lengths().begin(), pattern.lengths().end(), [](float length) { return length == 1.0f; });
}

}  // namespace

PlaneMaskTable::PlaneMaskTable(SamplePattern pattern, const PlaneMaskTableOptions& options)
    : pattern_(std::move(pattern)), options_(options) {
  if (options.resolution < 32 || options.resolution > 256) {
    throw std::invalid_argument(fmt::format("table resolution must be from 32 to 256, not {}", options.resolution));
  }
  if (options.thread_count < 0) {
    throw std::invalid_argument(fmt::format("thread_count must be at least 0, not {}", options.thread_count));
  }
  lut::obey_isa_environment();
  const auto start = std::chrono::steady_clock::now();
  cells_ = std::make_shared<lut::PlaneCells>(options.addressing, options.resolution);
  storage_ = fill(ends_of(pattern_), *cells_, options);
  words_ = storage_.get();
  stride_ = static_cast<std::size_t>(pattern_.word_count()) * (options.masks == PlaneMasks::must_may ? 2 : 1);
  if (!has_full_length(pattern_)) {
    directions_ = std::make_shared<PlaneMaskTable>(pattern_.with_falloff(Falloff::constant()), options);
  }
  build_seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::uint32_t PlaneMaskTable::cell(const glm::vec3& n, float d) const { return cells_->cell(n, d); }
std::uint32_t PlaneMaskTable::edge_cell(const glm::vec3& n) const { return cells_->edge_cell(n); }
const PlaneMaskTable& PlaneMaskTable::directions() const { return directions_ ? *directions_ : *this; }
std::uint32_t PlaneMaskTable::cell_count() const { return cells_->cell_count(); }

std::size_t PlaneMaskTable::memory_bytes() const {
  return cell_count() * stride_ * sizeof(std::uint64_t) + (directions_ ? directions_->memory_bytes() : 0);
}

}  // namespace lkao
