#include "scene/formats/vertex_joiner.h"

#include <bit>
#include <utility>

namespace lkao::scene {

namespace {

constexpr std::uint32_t kEmpty = 0xffffffffu;

std::uint64_t hash_of(const glm::dvec3& position) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    // Zero is added for the sake of -0.
    hash = (std::rotl(hash, 23) ^ std::bit_cast<std::uint64_t>(position[axis] + 0.0)) * 0x9e3779b97f4a7c15u;
  }
  return hash ^ hash >> 29;
}

}  // namespace

std::uint32_t VertexJoiner::index_of(const glm::dvec3& position) {
  const auto next = static_cast<std::uint32_t>(positions_.size());
  if (position != position) {
    positions_.push_back(position);
    return next;
  }
  if (2 * (used_count_ + 1) > slots_.size()) grow();
  std::uint32_t& slot = slots_[slot_of(position)];
  if (slot == kEmpty) {
    slot = next;
    ++used_count_;
    positions_.push_back(position);
  }
  return slot;
}

// Where the position is, or must go. There is always an empty slot.
std::size_t VertexJoiner::slot_of(const glm::dvec3& position) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash_of(position) & mask;
  while (slots_[slot] != kEmpty && positions_[slots_[slot]] != position) slot = (slot + 1) & mask;
  return slot;
}

void VertexJoiner::grow() {
  const std::vector<std::uint32_t> old =
      std::exchange(slots_, std::vector<std::uint32_t>(slots_.empty() ? 64 : 2 * slots_.size(), kEmpty));
  for (const std::uint32_t vertex : old) {
    if (vertex != kEmpty) slots_[slot_of(positions_[vertex])] = vertex;
  }
}

}  // namespace lkao::scene
