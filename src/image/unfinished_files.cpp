#include "image/unfinished_files.h"

#include <climits>
#include <cstring>

#include <atomic>

#include <unistd.h>

#include "image/atomic_file.h"

namespace lkao::image {
namespace {

// kFilling and kRemoving belong to whoever put them there: a path is never read while it is being written, nor written
// while the signal handler reads it.
enum State : int { kFree, kFilling, kUsed, kRemoving };

struct Slot {
  std::atomic<int> state{kFree};
  char path[PATH_MAX];
};
static_assert(std::atomic<int>::is_always_lock_free, "signal handlers may use lock-free atomics only");

constexpr int kSlotCount = 64;
Slot slots[kSlotCount];

bool change_state(Slot& slot, int from, int to) { return slot.state.compare_exchange_strong(from, to); }

}  // namespace

int remember_unfinished_file(const std::string& path) {
  if (path.size() >= PATH_MAX) return -1;
  for (int i = 0; i < kSlotCount; ++i) {
    if (!change_state(slots[i], kFree, kFilling)) continue;
    std::memcpy(slots[i].path, path.c_str(), path.size() + 1);
    slots[i].state.store(kUsed);
    return i;
  }
  return -1;
}

void forget_unfinished_file(int slot) {
  // Where a handler has taken the slot, it keeps it: the program is about to end.
  change_state(slots[slot], kUsed, kFree);
}

void remove_unfinished_files() {
  for (Slot& slot : slots) {
    if (change_state(slot, kUsed, kRemoving)) ::unlink(slot.path);
  }
}

}  // namespace lkao::image
