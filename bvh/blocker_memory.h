// What blocked the rays of the receivers before: tested first, it spares most rays of a neighbour the traversal.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "bvh/layout.h"

namespace lkao::bvh {

// Of one hierarchy, for one thread at a time. No bit of a mask depends on it: a leaf that it names is tested like any
// other, and rays that no such leaf blocks are traced as always.
class BlockerMemory {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  // Directions are told apart by cells of the octahedron, this many along each axis.
  static constexpr int kCellsPerAxis = 96;

  // How much was done for a receiver that was traced without guesses.
  struct Work {
    int ray_count = 0, blocked_count = 0;
    int pair_count = 0;  // of a ray and a node or leaf
    int test_count = 0;  // of 16 rays and a box
  };

  // To be called for each receiver: should it be traced with guesses? Every kPeriod receivers one is traced without,
  // and says by observe() what the next ones do.
  bool should_guess() {
    is_observed_ = age_ == 0;
    age_ = (age_ + 1) % kPeriod;
    return guesses_now();
  }
  // What it said last.
  bool guesses_now() const { return guesses_ && !is_observed_; }
  // True where the receiver that should_guess() was last called for is such a one.
  bool is_observed() const { return is_observed_; }

  // Guesses cost some ten nanoseconds a ray. They pay where many rays are blocked, and only after some work: pairs, and
  // tests, which cost a third.
  void observe(const Work& work) {
    const float share = static_cast<float>(work.blocked_count) / static_cast<float>(work.ray_count);
    const float pairs = static_cast<float>(3 * work.pair_count + work.test_count);
    guesses_ = share * share * pairs >= 0.75f * static_cast<float>(3 * work.ray_count);
    if (guesses_ && leaves_ == nullptr) {
      leaves_ = std::make_unique<std::uint32_t[]>(kCellCount);
      std::fill_n(leaves_.get(), kCellCount, kNone);
    }
  }

  // By cell, the leaf that blocked its last ray, or kNone. Only once should_guess() said so.
  std::uint32_t* leaves() { return leaves_.get(); }

  // Leaves that blocked many rays of a receiver at once, as children of a node.
  const Node& first() const { return first_; }
  int first_count() const { return first_count_; }

  // A leaf that blocked so many rays.
  void offer(ChildRef leaf, const Bounds& box, int blocked_count) {
    int place = 0;
    for (int i = 0; i < first_count_; ++i) {
      if (first_.children[i].bits() == leaf.bits()) return;
      if (scores_[i] < scores_[place]) place = i;
    }
    if (first_count_ < kWidth) {
      place = first_count_++;
    } else if (scores_[place] >= blocked_count) {
      return;
    }
    first_.set_child(place, box, leaf);
    scores_[place] = blocked_count;
  }

  // Child `place` of first() blocked so many rays of this receiver.
  void score(int place, int blocked_count) { scores_[place] = (scores_[place] + blocked_count) / 2; }

  // Forgets the leaves of first() that blocked fewer rays of late.
  void drop_below(int least) {
    for (int i = 0; i < first_count_;) {
      if (scores_[i] >= least) {
        ++i;
        continue;
      }
      --first_count_;
      first_.set_child(i, first_.child_bounds(first_count_), first_.children[first_count_]);
      scores_[i] = scores_[first_count_];
      first_.clear_child(first_count_);
    }
  }

 private:
  static constexpr unsigned kPeriod = 64;
  static constexpr std::size_t kCellCount = std::size_t{kCellsPerAxis} * kCellsPerAxis;

  bool guesses_ = false, is_observed_ = false;
  unsigned age_ = 0;
  int first_count_ = 0;
  int scores_[kWidth] = {};
  std::unique_ptr<std::uint32_t[]> leaves_;
  Node first_ = Node::empty();
};

}  // namespace lkao::bvh
