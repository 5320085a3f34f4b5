// Memories of blockers, lent to whoever traces: one to a thread at a time.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

#include "bvh/blocker_memory.h"

namespace lkao::query {

// Of the levels of one query. A thread gets back what it had last, as long as threads are few; none waits for another.
// At most kSlotCount of them are kept, for as long as this lives: not for the life of threads.
class BlockerMemories {
 public:
  using Levels = std::vector<bvh::BlockerMemory>;

  explicit BlockerMemories(std::size_t level_count) : level_count_(level_count) {}
  ~BlockerMemories();
  BlockerMemories(const BlockerMemories&) = delete;
  BlockerMemories& operator=(const BlockerMemories&) = delete;

  // Goes back at the end of its life.
  class Loan {
   public:
    explicit Loan(BlockerMemories& memories);
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    // Where another thread with the same slot was faster, that one's is forgotten.
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
