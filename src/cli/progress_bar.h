// A progress bar on stderr, for people: it draws on terminals only.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "lkao/progress.h"

namespace lkao::cli {

// One line that is drawn over itself, at most ten times a second, and wiped at the end of its life.
class ProgressBar {
 public:
  // Draws nothing unless `wanted` and stderr is a terminal.
  explicit ProgressBar(bool wanted);
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  // A phase whose end cannot be foreseen: shows its name only.
  void begin(const std::string& phase);
  // A phase of a call that tells how far it is: what to give it. The bar must outlive the call.
  Progress watch(const std::string& phase);
  // Wipes the line, to make room for other output.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  void draw();

  bool visible_;
  std::string phase_;
  std::uint64_t total_ = 0;
  std::uint64_t done_ = 0;
  Clock::time_point start_;
  Clock::time_point last_drawn_;
};

}  // namespace lkao::cli
