// Memory for arrays that are read here and there: large ones get large pages, so that reading them does not wait for
// address translation as well.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace lkao::bvh {

// A standard allocator. Storage is aligned for vectors; from 4 MiB on it asks Linux for pages of 2 MiB.
template <typename T>
class HugePageAllocator {
 public:
  using value_type = T;

  HugePageAllocator() = default;
  template <typename U>
  explicit HugePageAllocator(const HugePageAllocator<U>&) {}

  T* allocate(std::size_t count) {
    if (count > std::numeric_limits<std::size_t>::max() / 4 / sizeof(T)) throw std::bad_array_new_length();
    const bool is_large = count >= 2 * kHugePage / sizeof(T);
    const std::size_t alignment = is_large ? kHugePage : 64;
    const std::size_t size = (count * sizeof(T) + alignment - 1) / alignment * alignment;
    void* memory = std::aligned_alloc(alignment, size);
    if (memory == nullptr) throw std::bad_alloc();
#ifdef __linux__
    if (is_large) madvise(memory, size, MADV_HUGEPAGE);  // a wish: without it all still works
#endif
    return static_cast<T*>(memory);
  }
  // Makes elements without a value, so that a vector resizes without touching its memory: who fills it, and on which
  // threads, is for others to say.
  template <typename U>
  void construct(U* element) {
    ::new (static_cast<void*>(element)) U;
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }

  friend bool operator==(const HugePageAllocator&, const HugePageAllocator&) { return true; }

 private:
  static constexpr std::size_t kHugePage = std::size_t{2} << 20;
};

}  // namespace lkao::bvh
