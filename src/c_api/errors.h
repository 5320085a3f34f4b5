// Exceptions become statuses here, and their messages what lkao_last_error() returns.
#pragma once

#include <stdexcept>
#include <string>

#include "lkao/c/status.h"

namespace lkao::c_api {

// What ends a call with a status of its own.
class Error : public std::runtime_error {
 public:
  Error(lkao_status status, const std::string& message) : std::runtime_error(message), status_(status) {}
  lkao_status status() const { return status_; }

 private:
  lkao_status status_;
};

// Throws the error of a wrong argument.
[[noreturn]] void refuse(const std::string& message);

// Of the exception that is being handled: keeps its message for this thread, and returns its status. `function` is what
// the caller called.
lkao_status handle_exception(const char* function) noexcept;

// Calls `body` and lets no exception out.
template <typename Body>
lkao_status guard(const char* function, const Body& body) noexcept {
  try {
    body();
    return LKAO_OK;
  } catch (...) {
    return handle_exception(function);
  }
}

// The same for functions that return a value: `otherwise` stands for a failure.
template <typename Value, typename Body>
Value guard_value(const char* function, Value otherwise, const Body& body) noexcept {
  try {
    return body();
  } catch (...) {
    handle_exception(function);
    return otherwise;
  }
}

// An argument that must not be NULL.
template <typename Value>
Value* needed(Value* pointer, const char* name) {
  if (pointer == nullptr) refuse(std::string(name) + " must not be NULL");
  return pointer;
}

}  // namespace lkao::c_api
