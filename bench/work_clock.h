// The time that a method is charged with.
#pragma once

#include <ctime>

namespace lkao::bench {

// One thread: CPU time of the calling thread, since other programs on a shared machine take turns with it and that is
// not the method's time. Several threads: wall time, so that waiting for each other counts.
class WorkClock {
 public:
  explicit WorkClock(int thread_count)
      : clock_(thread_count == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC), start_(now()) {}

  // Since construction; to be called from the thread that constructed it.
  double seconds() const { return now() - start_; }

 private:
  double now() const {
    timespec time{};
    clock_gettime(clock_, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  clockid_t clock_;
  double start_;
};

}  // namespace lkao::bench
