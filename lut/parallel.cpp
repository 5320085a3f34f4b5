#include "lut/parallel.h"

#include <algorithm>
#include <atomic>
#include <future>
#include <system_error>
#include <thread>
#include <vector>

namespace lkao::lut {

void for_each_part(std::uint32_t count, std::uint32_t grain, int thread_count,
                   const std::function<void(std::uint32_t first, std::uint32_t last)>& body) {
  const std::uint32_t part_count = count / grain + (count % grain != 0);
  std::atomic<std::uint32_t> next_part{0};
  const auto work = [&] {
    for (std::uint32_t part = next_part++; part < part_count; part = next_part++) {
      body(part * grain, std::min(count - part * grain, grain) + part * grain);
    }
  };
  const unsigned wanted = thread_count > 0 ? static_cast<unsigned>(thread_count) : std::thread::hardware_concurrency();
  std::vector<std::future<void>> helpers;  // which their destructors wait for; libc++ has no std::jthread yet
  try {
    for (unsigned i = 1; i < std::min(wanted, part_count); ++i) helpers.push_back(std::async(std::launch::async, work));
  } catch (const std::system_error&) {
    // No more threads are to be had: those that there are do the work.
  }
  work();
}

}  // namespace lkao::lut
