// Work of independent parts on several threads, for what must not need oneTBB.
#pragma once

#include <cstdint>
#include <functional>

namespace lkao::lut {

// Calls `body(first, last)` for consecutive parts of [0, count) of at most `grain`, in any order, on up to
// `thread_count` threads, the caller's among them; 0: as many as the process may run at once. Returns when all is done.
// `body` must not throw.
void for_each_part(std::uint32_t count, std::uint32_t grain, int thread_count,
                   const std::function<void(std::uint32_t first, std::uint32_t last)>& body);

}  // namespace lkao::lut
