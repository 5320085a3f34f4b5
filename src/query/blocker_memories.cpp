#include "query/blocker_memories.h"

namespace lkao::query {
namespace {

// Threads in the order in which they first ask.
std::size_t number_of_this_thread() {
  static std::atomic<std::size_t> count = 0;
  static thread_local const std::size_t number = count.fetch_add(1, std::memory_order_relaxed);
  return number;
}

}  // namespace

BlockerMemories::~BlockerMemories() {
  for (std::atomic<Levels*>& slot : slots_) delete slot.load(std::memory_order_acquire);
}

BlockerMemories::Loan::Loan(BlockerMemories& memories)
    : slot_(memories.slots_[number_of_this_thread() % kSlotCount]),
      levels_(slot_.exchange(nullptr, std::memory_order_acq_rel)) {
  if (levels_ == nullptr) levels_ = std::make_unique<Levels>(memories.level_count_);
}

}  // namespace lkao::query
