// The values of a PLY file, one after another: as bytes of either order, or as words of a text.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "scene/formats/ply_header.h"
#include "scene/formats/text.h"

namespace lkao::scene::ply {

struct EndOfData {};  // thrown where a value is not all there

// Both classes have
//   double read(Type)          the next value; int64 beyond 2^53 are rounded
//   std::size_t bytes_left()   to see a senseless count before memory is asked for
//   void end_record()          behind the last value of each record

template <bool kSwapped>
class BinaryValues {
 public:
  explicit BinaryValues(std::string_view data) : next_(data.data()), end_(data.data() + data.size()) {}

  double read(Type type) {
    switch (type) {
      case Type::int8:
        return take<std::int8_t>();
      case Type::uint8:
        return take<std::uint8_t>();
      case Type::int16:
        return take<std::int16_t>();
      case Type::uint16:
        return take<std::uint16_t>();
      case Type::int32:
        return take<std::int32_t>();
      case Type::uint32:
        return take<std::uint32_t>();
      case Type::int64:
        return static_cast<double>(take<std::int64_t>());
      case Type::uint64:
        return static_cast<double>(take<std::uint64_t>());
      case Type::float32:
        return static_cast<double>(take<float>());
      case Type::float64:
        return take<double>();
    }
    return 0;
  }
  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - next_); }
  void end_record() {}

 private:
  template <typename T>
  T take() {
    if (bytes_left() < sizeof(T)) throw EndOfData{};
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), next_, sizeof(T));
    next_ += sizeof(T);
    if constexpr (kSwapped) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  }

  const char* next_;
  const char* end_;
};

// Every record stands on a line of its own, with more on it perhaps than the header names; a record may go on on the
// next. Only where there are too few lines for that, values follow each other whatever the line.
class TextValues {
 public:
  TextValues(std::string_view data, std::size_t record_count)
      : rest_(data), has_lines_(has_lines_for(data, record_count)) {}

  double read(Type) {
    skip_blanks(rest_);
    double value = 0;
    const char* const end = rest_.data() + rest_.size();
    const auto [behind, error] = std::from_chars(rest_.data(), end, value);
    // Most words are plain numbers, and need not be looked at twice.
    if (error != std::errc() || (behind != end && !is_blank(*behind))) return read_word();
    rest_.remove_prefix(static_cast<std::size_t>(behind - rest_.data()));
    return value;
  }
  std::size_t bytes_left() const { return rest_.size(); }
  void end_record() {
    if (!has_lines_) return;
    std::string_view line;
    take_line(rest_, line);
  }

 private:
  double read_word() {
    const std::string_view word = take_word(rest_);
    if (word.empty()) throw EndOfData{};
    return parse_number(word);
  }
  static bool has_lines_for(std::string_view data, std::size_t record_count) {
    std::size_t line_count = 0;
    std::string_view line;
    while (line_count < record_count && take_line(data, line)) {
      if (!take_word(line).empty()) ++line_count;
    }
    return line_count == record_count;
  }

  std::string_view rest_;
  bool has_lines_;
};

}  // namespace lkao::scene::ply
