// Errors as values, for programs that are compiled without exceptions.
#pragma once

#include <string>

namespace lkao::gl {

// What became of a call whose name begins with try_: it does what the function without does, and gives back what that
// would have thrown.
struct [[nodiscard]] Status {
  // One line; empty where nothing went wrong.
  std::string message;

  bool ok() const { return message.empty(); }
  explicit operator bool() const { return ok(); }
};

// What happens to an error that OpenGL has pending when a call begins: somebody else's, who did not ask.
enum class HostErrors {
  reported,  // thrown, before anything is done
  dropped,   // taken off and forgotten: an old harmless fault of a program is not to end it
};

}  // namespace lkao::gl
