#include "cli/progress_bar.h"

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace lkao::cli {
namespace {

constexpr int kBarWidth = 40;
constexpr std::chrono::milliseconds kRedrawInterval{100};
constexpr const char* kWipeLine = "\r\033[K";

}  // namespace

ProgressBar::ProgressBar(bool wanted) : visible_(wanted && isatty(STDERR_FILENO) == 1) {}

void ProgressBar::begin(const std::string& phase) {
  phase_ = phase;
  total_ = done_ = 0;
  start_ = Clock::now();
  draw();
}

Progress ProgressBar::watch(const std::string& phase) {
  begin(phase);
  return [this](std::size_t done, std::size_t total) {
    done_ = done;
    total_ = total;
    if (Clock::now() - last_drawn_ >= kRedrawInterval) draw();
    return true;
  };
}

void ProgressBar::clear() {
  if (visible_) fmt::print(stderr, "{}", kWipeLine);
}

void ProgressBar::draw() {
  if (!visible_) return;
  last_drawn_ = Clock::now();
  if (total_ == 0) {
    fmt::print(stderr, "{}{} ...", kWipeLine, phase_);
    return;
  }
  const double share = static_cast<double>(done_) / static_cast<double>(total_);
  const double seconds = std::chrono::duration<double>(last_drawn_ - start_).count();
  const int filled = static_cast<int>(share * kBarWidth);
  const std::string left = done_ == 0 ? "" : fmt::format(", {:.0f} s left", seconds * (1 - share) / share);
  fmt::print(stderr, "{}{} [{:=<{}}{:{}}] {:3.0f} %{}", kWipeLine, phase_, "", filled, "", kBarWidth - filled,
             100 * share, left);
}

}  // namespace lkao::cli
