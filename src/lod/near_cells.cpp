#include "lod/near_cells.h"

#include <algorithm>
#include <bit>
#include <numbers>

#include <glm/common.hpp>

namespace lkao::lod {
namespace {

constexpr double kCellsPerDistance = 3;
constexpr int kBitsPerAxis = 20;
constexpr std::size_t kLeastCells = 1u << 8, kMostCells = 1u << 22;

}  // namespace

NearCells::NearCells(const Surface& surface, double distance, const glm::dvec3& lower, std::size_t cell_count)
    : surface_(surface),
      distance_(distance),
      width_(distance / kCellsPerDistance),
      lower_(lower - 2 * distance),
      cells_(std::bit_ceil(std::clamp(cell_count, kLeastCells, kMostCells))) {}

bool NearCells::is_within(const glm::dvec3& point) const {
  constexpr double kEnd = 1 << kBitsPerAxis;
  const glm::dvec3 cell = glm::floor((point - lower_) / width_);
  const bool is_numbered = cell.x >= 0 && cell.y >= 0 && cell.z >= 0 && cell.x < kEnd && cell.y < kEnd && cell.z < kEnd;
  if (!is_numbered) return surface_.is_within(point, distance_);

  constexpr std::uint64_t kGoldenRatio = 0x9e3779b97f4a7c15u;
  const std::uint64_t number =
      ((static_cast<std::uint64_t>(cell.x) << kBitsPerAxis | static_cast<std::uint64_t>(cell.y)) << kBitsPerAxis) |
      static_cast<std::uint64_t>(cell.z);
  const std::uint64_t place = (number * kGoldenRatio) >> (64 - std::countr_zero(cells_.size()));
  std::atomic<std::uint64_t>& word = cells_[place];
  const std::uint64_t known = word.load(std::memory_order_relaxed);
  State state = known >> 2 == number ? State{known & 3} : State::unknown;
  if (state == State::unknown) {
    state = state_of(cell);
    word.store(number << 2 | static_cast<std::uint64_t>(state), std::memory_order_relaxed);
  }
  return state == State::mixed ? surface_.is_within(point, distance_) : state == State::within;
}

NearCells::State NearCells::state_of(const glm::dvec3& cell) const {
  constexpr double kMargin = 1.000001;  // more than rounding moves a point across the side of a cell
  const double reach = 0.5 * std::numbers::sqrt3 * width_ * kMargin;
  const double distance = surface_.nearest(lower_ + (cell + 0.5) * width_, distance_ + reach).distance;
  if (distance + reach <= distance_) return State::within;
  return distance - reach > distance_ ? State::beyond : State::mixed;
}

}  // namespace lkao::lod
