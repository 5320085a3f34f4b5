// Mistakes come back as exceptions that name them in one line.
#pragma once

#include <functional>
#include <string>

#include <gtest/gtest.h>

namespace lkao::gl::tests {

template <typename Error>
void expect_error(const std::string& named, const std::function<void()>& mistake) {
  try {
    mistake();
    ADD_FAILURE() << "no exception about " << named;
  } catch (const Error& error) {
    const std::string line = error.what();
    EXPECT_NE(line.find(named), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
}

}  // namespace lkao::gl::tests
