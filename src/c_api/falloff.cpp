#include "lkao/c/falloff.h"

#include <array>
#include <string>
#include <string_view>

#include "c_api/convert.h"
#include "c_api/errors.h"

using namespace lkao::c_api;

namespace {

constexpr std::array kNames{"constant", "linear", "smooth", "exponential", "custom"};

void check_share(double share, const char* name) {
  if (!(share >= 0 && share <= 1)) refuse(std::string(name) + " must be in [0, 1], not " + std::to_string(share));
}

}  // namespace

lkao_status lkao_falloff_value(const lkao_falloff* falloff, double x, double* value) {
  return guard(__func__, [&] {
    needed(value, "value");
    check_share(x, "x");
    *value = lkao::c_api::falloff_of(falloff, "falloff")(x);
  });
}

lkao_status lkao_falloff_length_at(const lkao_falloff* falloff, double u, double* length) {
  return guard(__func__, [&] {
    needed(length, "length");
    check_share(u, "u");
    *length = lkao::c_api::falloff_of(falloff, "falloff").length_at(u);
  });
}

const char* lkao_falloff_kind_name(lkao_falloff_kind kind) {
  return kind >= 0 && kind < static_cast<int>(kNames.size()) ? kNames[static_cast<std::size_t>(kind)] : nullptr;
}

lkao_status lkao_falloff_kind_named(const char* name, lkao_falloff_kind* kind) {
  return guard(__func__, [&] {
    needed(kind, "kind");
    const std::string_view wanted = needed(name, "name");
    for (std::size_t i = 0; i < kNames.size(); ++i) {
      if (wanted != kNames[i]) continue;
      *kind = static_cast<lkao_falloff_kind>(i);
      return;
    }
    refuse("name must be constant, linear, smooth, exponential or custom, not " + std::string(wanted));
  });
}
