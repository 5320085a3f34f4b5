// What is known of triangles with holes before a ray asks: squares of (u, v) that are all clear or all opaque.
//
// Based on: H. Gruen, C. Benthin, S. Woop, "Sub-Triangle Opacity Masks for Faster Ray Tracing of Transparent Objects",
// PACMCGIT 3(2), 2020. Differs from the paper: squares of a grid instead of sub-triangles, found by two products.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lkao/cut_outs.h"

namespace lkao::bvh {

class HoleGrids {
 public:
  // Nothing is known.
  HoleGrids() = default;
  // Asks the survey, in parallel.
  HoleGrids(const CutOuts& cut_outs, std::size_t triangle_count);

  // At that very point.
  CutOutPart at(std::uint32_t primitive, float u, float v) const {
    if (entries_.empty()) return CutOutPart::mixed;
    const Entry entry(entries_[primitive]);
    return part(entry, entry.place_of(u), entry.place_of(v));
  }

  // Of the whole triangle.
  CutOutPart of(std::uint32_t primitive) const {
    if (entries_.empty()) return CutOutPart::mixed;
    return Entry(entries_[primitive]).level == 0 ? at(primitive, 0, 0) : CutOutPart::mixed;
  }

  std::size_t memory_bytes() const { return sizeof(std::uint32_t) * (entries_.size() + words_.size()); }

  // 2^this squares each way, at most.
  static constexpr int kFinest = 8;

  // For vectors. An entry of each primitive, null where nothing is known: from kLevelShift on the level, below it the
  // first of the words. They hold 2^level rows of 2^level squares, 2 bits each, 16 a word.
  const std::uint32_t* entries() const { return entries_.empty() ? nullptr : entries_.data(); }
  const std::uint32_t* words() const { return words_.data(); }
  static constexpr int kLevelShift = 28;
  static constexpr int kSquaresAWord = 16;

 private:
  struct Entry {
    explicit Entry(std::uint32_t bits)
        : level(static_cast<int>(bits >> kLevelShift)), first(bits & ((1u << kLevelShift) - 1)) {}

    // The row or column with that coordinate; finite, and not far from [0, 1].
    int place_of(float coordinate) const {
      const int size = 1 << level;
      return std::clamp(static_cast<int>(coordinate * static_cast<float>(size)), 0, size - 1);
    }

    int level;
    std::uint32_t first;
  };

  CutOutPart part(const Entry& entry, int column, int row) const {
    const auto square = static_cast<std::uint32_t>((row << entry.level) + column);
    return static_cast<CutOutPart>(words_[entry.first + square / kSquaresAWord] >> (2 * (square % kSquaresAWord)) & 3);
  }

  std::vector<std::uint32_t> entries_;  // by primitive; empty where nothing is known
  std::vector<std::uint32_t> words_;
};

}  // namespace lkao::bvh
