// Ctrl-C and its kin: the program ends at once and leaves no unfinished file.
#pragma once

namespace lkao::cli {

// From now on SIGINT, SIGTERM, SIGHUP and SIGPIPE remove the unfinished output files and end the process with exit
// code 128 + signal (130 for Ctrl-C). A signal that the parent chose to have ignored stays ignored.
void install_interrupt_handlers();

// While one lives, those signals are ignored: for the moment in which several finished files get their names, so that
// all of them appear or none.
class InterruptHold {
 public:
  InterruptHold();
  ~InterruptHold();
  InterruptHold(const InterruptHold&) = delete;
  InterruptHold& operator=(const InterruptHold&) = delete;
};

}  // namespace lkao::cli
