#include "bench/report/interrupt.h"

#include <csignal>
#include <string_view>

#include <unistd.h>

#include "image/atomic_file.h"

namespace lkao::bench {
namespace {

constexpr std::string_view kStopped = "stopped; the same command goes on from here\n";

// Only async-signal-safe calls in here.
void end_program(int signal) {
  image::remove_unfinished_files();
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, kStopped.data(), kStopped.size());
  _exit(128 + signal);
}

}  // namespace

StopsAtInterrupt::StopsAtInterrupt() : before_(std::signal(SIGINT, end_program)) {}
StopsAtInterrupt::~StopsAtInterrupt() { std::signal(SIGINT, before_); }

}  // namespace lkao::bench
