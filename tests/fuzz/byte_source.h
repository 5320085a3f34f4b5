// Reads a fuzzer's bytes as choices and numbers. Once they are used up, everything is 0: any bytes are a case.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

namespace lkao::tests {

class ByteSource {
 public:
  explicit ByteSource(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint32_t next_byte() {
    if (bytes_.empty()) return 0;
    const std::uint32_t byte = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return byte;
  }
  std::uint32_t next_short() {
    const std::uint32_t low = next_byte();
    return low | next_byte() << 8;
  }

  // In [0, count); count is at most 65536.
  std::uint32_t below(std::size_t count) {
    const auto limit = static_cast<std::uint32_t>(count);
    return (limit <= 256 ? next_byte() : next_short()) % limit;
  }
  // True in one of `count` cases.
  bool once_in(std::uint32_t count) { return below(count) == count - 1; }

  template <typename Value, std::size_t kCount>
  const Value& pick(const Value (&values)[kCount]) {
    return values[below(kCount)];
  }

  // In [0, 1]: 65536 steps.
  float share() { return static_cast<float>(next_short()) / 65535.0f; }
  // In [-1, 1]; no step is 0, as no rounded coordinate of a real mesh is.
  float coordinate() { return 2 * share() - 1; }
  glm::vec3 point() {
    const float x = coordinate(), y = coordinate();
    return {x, y, coordinate()};
  }
  // Any bits: NaN, infinities, denormal numbers.
  float any_float() {
    const std::uint32_t low = next_short();
    return std::bit_cast<float>(low | next_short() << 16);
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

}  // namespace lkao::tests
