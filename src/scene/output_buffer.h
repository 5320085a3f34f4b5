// Many small pieces of a file, few writes.
#pragma once

#include <cstddef>
#include <cstring>
#include <iterator>
#include <ostream>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace lkao::scene {

class OutputBuffer {
 public:
  explicit OutputBuffer(std::ostream& out) : out_(out) {}
  ~OutputBuffer() { flush(); }
  OutputBuffer(const OutputBuffer&) = delete;
  OutputBuffer& operator=(const OutputBuffer&) = delete;

  // The bytes of a value as they lie in memory.
  template <typename T>
  void put(const T& value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    bytes_.append(bytes, sizeof(T));
    flush_if_full();
  }

  template <class... Values>
  void print(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(bytes_), format, std::forward<Values>(values)...);
    flush_if_full();
  }

 private:
  static constexpr std::size_t kFlushSize = 1 << 16;

  void flush_if_full() {
    if (bytes_.size() >= kFlushSize) flush();
  }
  void flush() {
    out_.write(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
    bytes_.clear();
  }

  std::ostream& out_;
  std::string bytes_;
};

}  // namespace lkao::scene
