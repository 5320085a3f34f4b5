// Three numbers of fragments, counted by shaders (gpu/gl/fragment_counters.glsl).
#pragma once

#include <array>
#include <cstdint>

#include "gpu/gl/error.h"
#include "gpu/gl/objects.h"

namespace lkao::gl {

class FragmentCounters {
 public:
  // From zero, at atomic counter buffer 0.
  void begin() const {
    const GLuint zeros[6] = {};
    glNamedBufferSubData(buffer_.name(), 0, sizeof(zeros), zeros);
    glBindBufferBase(GL_ATOMIC_COUNTER_BUFFER, 0, buffer_.name());
  }

  // Waits for the GPU.
  std::array<std::uint64_t, 3> read() const {
    std::array<std::uint32_t, 6> words{};
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffer_.name(), 0, sizeof(words), words.data());
    check_errors("reading the counters");
    std::array<std::uint64_t, 3> counts{};
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = words[2 * i] | std::uint64_t{words[2 * i + 1]} << 32;
    return counts;
  }

 private:
  Buffer buffer_ = make_buffer(24, nullptr, GL_DYNAMIC_STORAGE_BIT);
};

}  // namespace lkao::gl
