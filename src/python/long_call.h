// Calls that take long: without the interpreter's lock, to be watched and to be stopped.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <thread>
#include <utility>

#include <pybind11/pybind11.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "lkao/progress.h"

namespace lkao::python {

namespace py = pybind11;

// What a call's progress does now and then: looks whether Ctrl-C was pressed, and tells the caller's function. Python
// hears signals in its main thread alone, which works with the others on the call when it is the one that calls.
class Watch {
 public:
  // `callback`: None, or a function of (done, total), which stops the call by returning False.
  explicit Watch(py::object callback) : callback_(std::move(callback)) {}

  Progress progress() {
    return [this](std::size_t done, std::size_t total) { return look(done, total); };
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr Clock::duration kPause = std::chrono::milliseconds(50);

  // Called by one thread at a time, without the interpreter's lock.
  bool look(std::size_t done, std::size_t total) {
    const Clock::time_point now = Clock::now();
    const bool may_hear = std::this_thread::get_id() == caller_ && now >= next_signals_;
    const bool may_tell = !callback_.is_none() && (now >= next_callback_ || done == total);
    if (!may_hear && !may_tell) return true;
    const py::gil_scoped_acquire lock;
    if (may_hear) {
      next_signals_ = now + kPause;
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
    if (!may_tell) return true;
    next_callback_ = now + kPause;
    return !callback_(done, total).is(py::bool_(false));
  }

  py::object callback_;
  std::thread::id caller_ = std::this_thread::get_id();
  Clock::time_point next_signals_ = Clock::now() + kPause;
  Clock::time_point next_callback_ = {};
};

// Returns work(progress), done on so many threads, 0: on all, with the interpreter's lock released.
template <typename Work>
auto long_call(int thread_count, py::object callback, const Work& work) {
  Watch watch(std::move(callback));
  const py::gil_scoped_release unlocked;
  if (thread_count == 0) return work(watch.progress());
  // More than oneTBB has are not only useless: it would print a warning.
  const std::size_t allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  tbb::task_arena arena(static_cast<int>(std::min(static_cast<std::size_t>(thread_count), allowed)));
  return arena.execute([&] { return work(watch.progress()); });
}

}  // namespace lkao::python
