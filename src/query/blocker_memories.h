// Memories of blockers, lent to threads while they trace.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

#include "bvh/blocker_memory.h"

namespace lkao::query {

// One memory for each thread and level of one query. A thread gets back the one that it had last, as long as there are
// at most kSlotCount threads; none ever waits for another. Memories live as long as this, not as long as threads.
class BlockerMemories {
 public:
  using Levels = std::vector<bvh::BlockerMemory>;

  explicit BlockerMemories(std::size_t level_count) : level_count_(level_count) {}
  ~BlockerMemories();
  BlockerMemories(const BlockerMemories&) = delete;
  BlockerMemories& operator=(const BlockerMemories&) = delete;

  // Given back when it is destroyed.
  class Loan {
   public:
    explicit Loan(BlockerMemories& memories);
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    // Where a thread with the same slot has given one back meanwhile, that one is deleted.
    ~Loan() { delete slot_.exchange(levels_.release(), std::memory_order_acq_rel); }

    bvh::BlockerMemory& operator[](std::size_t level) { return (*levels_)[level]; }

   private:
    std::atomic<Levels*>& slot_;
    std::unique_ptr<Levels> levels_;
  };

 private:
  static constexpr std::size_t kSlotCount = 64;

  std::size_t level_count_;
  std::array<std::atomic<Levels*>, kSlotCount> slots_ = {};
};

}  // namespace lkao::query
