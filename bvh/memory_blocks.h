// Memory for many small objects that live equally long, as std::pmr::monotonic_buffer_resource has it, which libc++ has
// from version 16 only.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace lkao::bvh {

class MemoryBlocks {
 public:
  // Aligned as any fundamental type wants it; given back with this object, without destructors.
  void* allocate(std::size_t size) {
    size = (size + kAlignment - 1) / kAlignment * kAlignment;
    if (size > left_) add_block(size);
    left_ -= size;
    return std::exchange(next_, next_ + size);
  }

 private:
  static constexpr std::size_t kAlignment = alignof(std::max_align_t);
  static constexpr std::size_t kBlockSize = std::size_t{1} << 16;

  void add_block(std::size_t size) {
    left_ = std::max(size, kBlockSize);
    blocks_.emplace_back(new std::byte[left_]);
    next_ = blocks_.back().get();
  }

  std::vector<std::unique_ptr<std::byte[]>> blocks_;
  std::byte* next_ = nullptr;
  std::size_t left_ = 0;
};

}  // namespace lkao::bvh
