#include "lut/require.h"

#include <stdexcept>

#include <fmt/format.h>

namespace lkao::lut {

void require(bool condition, const char* option, const char* range, double value) {
  if (!condition) throw std::invalid_argument(fmt::format("{} must be {}, not {}", option, range, value));
}

}  // namespace lkao::lut
