// Ctrl-C while a report is measured.
#pragma once

namespace lkao::bench {

// While one lives, Ctrl-C ends the program at once, whatever it is about, with one line and exit code 130. Files that
// are being written are removed; those that are whole stay.
class StopsAtInterrupt {
 public:
  StopsAtInterrupt();
  ~StopsAtInterrupt();
  StopsAtInterrupt(const StopsAtInterrupt&) = delete;
  StopsAtInterrupt& operator=(const StopsAtInterrupt&) = delete;

 private:
  void (*before_)(int);
};

}  // namespace lkao::bench
