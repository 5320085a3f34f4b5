// Tests with an OpenGL context on the CPU, which every machine with Mesa has, or, where the environment has
// LKAO_TEST_GL=hardware, on a GPU.
#pragma once

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "lkao/gl.h"

namespace lkao::gl::tests {

// Before any context: llvmpipe draws in the calling thread. Its own threads are still there when LeakSanitizer looks
// through the process at its end, which stops it now and then.
inline const int kIsWithoutThreads = setenv("LP_NUM_THREADS", "0", 0);

inline Device tested_device() {
  const char* word = std::getenv("LKAO_TEST_GL");
  return word != nullptr && std::string_view(word) == "hardware" ? Device::hardware : Device::software;
}

class OnSoftware : public ::testing::Test {
 protected:
  void SetUp() override {
    try {
      context_ = std::make_unique<HeadlessContext>(tested_device());
    } catch (const std::runtime_error& error) {
      GTEST_SKIP() << "OpenGL is NOT tested on this machine: " << error.what() << "; install libgl1-mesa-dri";
    }
    context_->make_current();
  }

  std::unique_ptr<HeadlessContext> context_;
};

}  // namespace lkao::gl::tests
