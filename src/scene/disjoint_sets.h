// Numbers that are joined into sets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace lkao::scene {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0u); }

  // The least number of the set.
  std::uint32_t find(std::uint32_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }

  void join(std::uint32_t i, std::uint32_t j) {
    i = find(i);
    j = find(j);
    if (i < j) parents_[j] = i;
    if (j < i) parents_[i] = j;
  }

 private:
  std::vector<std::uint32_t> parents_;  // each at most its own number
};

}  // namespace lkao::scene
