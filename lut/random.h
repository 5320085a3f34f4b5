// Small deterministic random numbers: the same on every machine and in any order of evaluation.
#pragma once

#include <cstdint>

namespace lkao::lut {

// Mixes 64 bits so that every input bit changes every output bit (Steele, Lea, Flood, "Fast Splittable Pseudorandom
// Number Generators", OOPSLA 2014: the finaliser of SplitMix64).
constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// A stream of numbers from a seed (SplitMix64, same paper).
class RandomStream {
 public:
  explicit constexpr RandomStream(std::uint64_t seed) : state_(mix_bits(seed)) {}

  constexpr std::uint64_t next_bits() {
    state_ += 0x9e3779b97f4a7c15u;
    return mix_bits(state_);
  }
  // Evenly in [0, 1), 53 bits.
  constexpr double next_double() { return static_cast<double>(next_bits() >> 11) * 0x1p-53; }
  // Evenly in [0, count).
  constexpr std::uint64_t next_below(std::uint64_t count) {
    return static_cast<std::uint64_t>(next_double() * static_cast<double>(count));
  }

 private:
  std::uint64_t state_;
};

}  // namespace lkao::lut
