// What methods that draw a whole view at once have in common.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "lkao/ambient_occlusion.h"
#include "method/median.h"
#include "method/stopwatch.h"

namespace lkao::method {

struct FrameTimes {
  double seconds = 0;  // the median
  int frame_count = 0;
};

// `draw` returns its seconds. A frame is drawn again while its time is short, so that it does not depend on what a
// driver does once.
template <class Draw>
FrameTimes draw_repeatedly(const Draw& draw) {
  constexpr int kMaxFrameCount = 5;
  constexpr double kEnoughSeconds = 1;
  std::vector<double> seconds;
  const Stopwatch watch;
  do {
    seconds.push_back(draw());
  } while (seconds.size() < kMaxFrameCount && watch.seconds() < kEnoughSeconds);
  return {median(seconds), static_cast<int>(seconds.size())};
}

// Of a frame whose pixels without a valid receiver are NaN; each of the others casts `ray_count` rays.
inline QueryReport count_receivers(std::span<const float> occlusion, int ray_count) {
  QueryReport report;
  report.receiver_count = occlusion.size();
  for (const float value : occlusion) report.invalid_receiver_count += std::isnan(value);
  report.ray_count = (report.receiver_count - report.invalid_receiver_count) * static_cast<std::uint64_t>(ray_count);
  return report;
}

// Does nothing where the output is not wanted. Throws std::invalid_argument for one of another size than the frame's.
template <class Value>
void copy_frame(const std::vector<Value>& frame, std::span<Value> output) {
  if (output.empty()) return;
  if (output.size() != frame.size()) {
    throw std::invalid_argument(fmt::format("an output of {} values for a frame of {}: frames are answered whole",
                                            output.size(), frame.size()));
  }
  std::copy(frame.begin(), frame.end(), output.begin());
}

}  // namespace lkao::method
