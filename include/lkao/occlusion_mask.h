// The answer to one query: which rays of a receiver are blocked, one bit a ray.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 3.1.
#pragma once

#include <cstdint>

#include "lkao/requirements.h"
#include "lkao/sample_pattern.h"

namespace lkao {

// Bit i belongs to ray i of the sample pattern: word i / 64, bit i % 64. Bits past the pattern's ray count
// are always 0 in what the library returns. A plain value of 128 bytes.
class OcclusionMask {
 public:
  static constexpr int kMaxWordCount = word_count_of(kMaxRayCount);

  bool test(int ray) const { return (words[ray / 64] >> (ray % 64) & 1u) != 0; }
  void set(int ray) { words[ray / 64] |= std::uint64_t{1} << (ray % 64); }
  void reset(int ray) { words[ray / 64] &= ~(std::uint64_t{1} << (ray % 64)); }

  // Number of set bits.
  int count() const {
    // Bits of every byte, added up over the words: compilers make vectors of it even where there is no such
    // instruction.
    static_assert(kMaxWordCount * 8 < 256);
    std::uint64_t bytes = 0;
    for (std::uint64_t word : words) {
      word -= word >> 1 & 0x5555555555555555u;
      word = (word & 0x3333333333333333u) + (word >> 2 & 0x3333333333333333u);
      bytes += (word + (word >> 4)) & 0x0f0f0f0f0f0f0f0fu;
    }
    const std::uint64_t pairs = (bytes & 0x00ff00ff00ff00ffu) + (bytes >> 8 & 0x00ff00ff00ff00ffu);
    return static_cast<int>(pairs * 0x0001000100010001u >> 48);
  }
  bool any() const {
    std::uint64_t all = 0;
    for (std::uint64_t word : words) all |= word;
    return all != 0;
  }

  friend OcclusionMask operator&(OcclusionMask a, const OcclusionMask& b) {
    for (int i = 0; i < kMaxWordCount; ++i) a.words[i] &= b.words[i];
    return a;
  }
  friend OcclusionMask operator|(OcclusionMask a, const OcclusionMask& b) {
    for (int i = 0; i < kMaxWordCount; ++i) a.words[i] |= b.words[i];
    return a;
  }
  // All 1024 bits: combine it with ReceiverRays::cast.
  OcclusionMask operator~() const {
    OcclusionMask inverse;
    for (int i = 0; i < kMaxWordCount; ++i) inverse.words[i] = ~words[i];
    return inverse;
  }
  friend bool operator==(const OcclusionMask&, const OcclusionMask&) = default;

  std::uint64_t words[kMaxWordCount] = {};
};

}  // namespace lkao
