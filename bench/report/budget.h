// How long a report may take, and how much of that is left.
#pragma once

#include <limits>

#include "method/stopwatch.h"

namespace lkao::bench {

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// Wall-clock time, in seconds, from when it is made.
class Budget {
 public:
  // `spent_before` of them by an earlier start.
  explicit Budget(double seconds, double spent_before = 0) : seconds_(seconds), spent_before_(spent_before) {}

  double spent() const { return spent_before_ + watch_.seconds(); }
  // Below 0 where more was spent than there was.
  double left() const { return seconds_ - spent(); }

 private:
  double seconds_, spent_before_;
  method::Stopwatch watch_;
};

}  // namespace lkao::bench
