// Adds up what the threads of a call have done, for its Progress.
#pragma once

#include <cstddef>
#include <mutex>

#include "lkao/progress.h"

namespace lkao::lut {

// Any thread. `progress` may be empty; it must outlive this.
class ProgressSum {
 public:
  ProgressSum(const Progress& progress, std::size_t total) : progress_(progress), total_(total) {}

  // Throws Cancelled where the call is to be stopped, in every thread from then on.
  void add(std::size_t count) {
    if (!progress_ || count == 0) return;
    const std::lock_guard lock(mutex_);
    if (!is_cancelled_) is_cancelled_ = !progress_(done_ += count, total_);
    if (is_cancelled_) throw Cancelled();
  }

 private:
  const Progress& progress_;
  std::size_t total_;
  std::size_t done_ = 0;
  bool is_cancelled_ = false;
  std::mutex mutex_;
};

}  // namespace lkao::lut
