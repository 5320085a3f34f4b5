// Exceptions as values.
#pragma once

#include <exception>
#include <utility>

#include "lkao/gl/status.h"

namespace lkao::gl {

// What `call` throws.
template <typename Call>
Status status_of(Call&& call) noexcept {
  try {
    std::forward<Call>(call)();
    return {};
  } catch (const std::exception& error) {
    return {error.what()};
  } catch (...) {
    return {"an unknown exception"};
  }
}

}  // namespace lkao::gl
