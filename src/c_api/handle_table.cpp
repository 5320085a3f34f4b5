#include "c_api/handle_table.h"

#include <array>
#include <atomic>
#include <bit>
#include <memory>
#include <mutex>
#include <new>
#include <string>

#include "c_api/errors.h"

namespace lkao::c_api {
namespace {

// Bits of a handle, from below: index, kind, age. The highest bit is set, which no address of a program has on 64-bit
// machines.
constexpr bool kIsWide = sizeof(std::uintptr_t) == 8;
constexpr int kIndexBits = kIsWide ? 24 : 16;
constexpr int kKindBits = kIsWide ? 8 : 4;
constexpr int kAgeShift = kIndexBits + kKindBits;
constexpr std::uintptr_t kMark = std::uintptr_t{1} << (8 * sizeof(std::uintptr_t) - 1);
constexpr std::uintptr_t kIndexMask = (std::uintptr_t{1} << kIndexBits) - 1;
constexpr std::uintptr_t kKindMask = (std::uintptr_t{1} << kKindBits) - 1;

struct Slot {
  // The handle of the object that is here; 0: none.
  std::atomic<std::uintptr_t> handle = 0;
  std::atomic<void*> object = nullptr;
  std::uintptr_t age = 0;
  std::size_t next_free = 0;  // index + 1; 0: none
};

// Slots are never freed: block b has kFirstBlock << b of them. Most programs never leave the first, which needs no
// memory of its own.
constexpr std::size_t kFirstBlock = 256;
constexpr int kFirstBlockBits = std::bit_width(kFirstBlock);
constexpr std::size_t kBlockCount = static_cast<std::size_t>(kIndexBits - kFirstBlockBits + 1);
constexpr std::size_t kCapacity = kFirstBlock * ((std::size_t{1} << kBlockCount) - 1);
static_assert(kCapacity <= kIndexMask);

constinit std::array<Slot, kFirstBlock> first_block;
constinit std::array<std::atomic<Slot*>, kBlockCount> blocks{first_block.data()};

constinit std::mutex mutex;  // of what follows, and of the slots' ages and next_free
constinit std::size_t used_count = 0, free_list = 0;
constinit std::atomic<std::size_t> alive_count = 0;

std::size_t block_of(std::size_t index) {
  const auto width = static_cast<std::size_t>(std::bit_width(index / kFirstBlock + 1));
  return width > 0 ? width - 1 : 0;  // it is: indices are far from the largest number
}

// Null where there is none yet.
Slot* slot_at(std::size_t index) {
  if (index >= kCapacity) return nullptr;
  const std::size_t block = block_of(index);
  Slot* const slots = blocks[block].load(std::memory_order_acquire);
  return slots == nullptr ? nullptr : slots + (index + kFirstBlock - (kFirstBlock << block));
}

// A free slot's index. The mutex is held.
std::size_t find_room() {
  if (free_list != 0) {
    const std::size_t index = free_list - 1;
    free_list = slot_at(index)->next_free;
    return index;
  }
  if (used_count == kCapacity) throw std::bad_alloc();
  const std::size_t block = block_of(used_count);
  if (blocks[block].load(std::memory_order_relaxed) == nullptr) {
    blocks[block].store(std::make_unique<Slot[]>(kFirstBlock << block).release(), std::memory_order_release);
  }
  return used_count++;
}

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::pattern:
      return "lkao_pattern";
    case Kind::table:
      return "lkao_table";
    case Kind::bvh:
      return "lkao_bvh";
    case Kind::scene:
      return "lkao_scene";
    case Kind::ao:
      return "lkao_ao";
    case Kind::neighbourhood:
      return "lkao_neighbourhood";
    case Kind::bundles:
      return "lkao_bundles";
    case Kind::shadows:
      return "lkao_shadows";
    case Kind::sky:
      return "lkao_sky";
  }
  return "handle of another library";
}

Kind kind_of(std::uintptr_t handle) { return static_cast<Kind>(handle >> kIndexBits & kKindMask); }

[[noreturn]] void refuse_handle(Kind kind, std::uintptr_t handle, const Slot* slot, const char* argument) {
  std::string message = argument;
  if (handle == 0) {
    message += " is NULL";
  } else if (slot == nullptr) {
    message += " was never a handle";
  } else if (slot->handle.load() != handle) {
    message += " was destroyed";
  } else {
    message += std::string(" is a ") + name_of(kind_of(handle));
  }
  throw Error(LKAO_ERROR_INVALID_HANDLE, message + ": it must be a " + name_of(kind));
}

// The slot of a living handle of that kind.
Slot& checked(Kind kind, std::uintptr_t handle, const char* argument) {
  Slot* const slot = (handle & kMark) != 0 ? slot_at(handle & kIndexMask) : nullptr;
  if (slot == nullptr || slot->handle.load(std::memory_order_acquire) != handle || kind_of(handle) != kind) {
    refuse_handle(kind, handle, slot, argument);
  }
  return *slot;
}

}  // namespace

std::uintptr_t enter(Kind kind, void* object) {
  const std::lock_guard lock(mutex);
  const std::size_t index = find_room();
  Slot& slot = *slot_at(index);
  const std::uintptr_t handle =
      kMark | slot.age++ << kAgeShift | static_cast<std::uintptr_t>(kind) << kIndexBits | index;
  slot.object.store(object, std::memory_order_relaxed);
  slot.handle.store(handle, std::memory_order_release);
  ++alive_count;
  return handle;
}

void* find(Kind kind, std::uintptr_t handle, const char* argument) {
  return checked(kind, handle, argument).object.load(std::memory_order_relaxed);
}

void* take(Kind kind, std::uintptr_t handle, const char* argument) {
  const std::lock_guard lock(mutex);
  Slot& slot = checked(kind, handle, argument);
  slot.handle.store(0, std::memory_order_release);
  slot.next_free = free_list;
  free_list = (handle & kIndexMask) + 1;
  --alive_count;
  return slot.object.exchange(nullptr, std::memory_order_relaxed);
}

std::size_t live_count() { return alive_count; }

}  // namespace lkao::c_api
