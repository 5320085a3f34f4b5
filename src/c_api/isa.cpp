#include "lkao/c/isa.h"

#include <algorithm>
#include <string>
#include <vector>

#include "c_api/errors.h"
#include "lkao/isa.h"

namespace {

// Kept, since callers get pointers.
const std::vector<std::string>& available() {
  static const std::vector<std::string> names = lkao::available_isas();
  return names;
}

}  // namespace

const char* lkao_available_isa(size_t i) {
  return lkao::c_api::guard_value(__func__, static_cast<const char*>(nullptr),
                                  [&] { return i < available().size() ? available()[i].c_str() : nullptr; });
}

const char* lkao_active_isa(void) {
  return lkao::c_api::guard_value(__func__, static_cast<const char*>(nullptr), [&]() -> const char* {
    const auto found = std::find(available().begin(), available().end(), lkao::active_isa());
    return found == available().end() ? nullptr : found->c_str();
  });
}

lkao_status lkao_force_isa(const char* name) {
  return lkao::c_api::guard(__func__, [&] { lkao::force_isa(name == nullptr ? "" : name); });
}
