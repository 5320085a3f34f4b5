// Arrays of callers, of any layout.
#pragma once

#include <cstddef>
#include <cstring>
#include <string>

#include "c_api/errors.h"

namespace lkao::c_api {

// The bytes from an entry to the next: `stride`, where 0 stands for `packed`, the size of an entry.
inline std::size_t checked_stride(std::size_t stride, std::size_t packed, const char* name) {
  if (stride != 0 && stride < packed) {
    refuse(std::string(name) + " must be 0 or at least " + std::to_string(packed) + " bytes, not " +
           std::to_string(stride));
  }
  return stride == 0 ? packed : stride;
}

// An array that may lie between other data; each entry is `Count` numbers. Null: there is none.
template <typename Number, std::size_t Count>
class Strided {
 public:
  Strided(Number* first, std::size_t stride, const char* name)
      : first_(first), stride_(checked_stride(stride, sizeof(Number) * Count, name)) {}

  explicit operator bool() const { return first_ != nullptr; }
  Number* data() const { return first_; }
  bool is_packed() const { return stride_ == sizeof(Number) * Count; }

  // Copies entry i to `to`, which has its size.
  void get(std::size_t i, void* to) const {
    std::memcpy(to, reinterpret_cast<const unsigned char*>(first_) + i * stride_, sizeof(Number) * Count);
  }
  void set(std::size_t i, const void* from) const {
    std::memcpy(reinterpret_cast<unsigned char*>(first_) + i * stride_, from, sizeof(Number) * Count);
  }

 private:
  Number* first_;
  std::size_t stride_;
};

}  // namespace lkao::c_api
