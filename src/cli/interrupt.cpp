#include "cli/interrupt.h"

#include <atomic>
#include <csignal>
#include <initializer_list>

#include <unistd.h>

#include "image/atomic_file.h"

namespace lkao::cli {
namespace {

std::atomic<int> hold_count{0};
static_assert(std::atomic<int>::is_always_lock_free);  // or the handler could not read it

// Only async-signal-safe calls in here.
void end_program(int signal) {
  if (hold_count.load() > 0) return;
  image::remove_unfinished_files();
  _exit(128 + signal);
}

}  // namespace

void install_interrupt_handlers() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler == SIG_IGN) continue;
    action = {};
    action.sa_handler = end_program;
    action.sa_flags = SA_RESTART;
    sigfillset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
}

InterruptHold::InterruptHold() { hold_count.fetch_add(1); }
InterruptHold::~InterruptHold() { hold_count.fetch_sub(1); }

}  // namespace lkao::cli
