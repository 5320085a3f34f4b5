// All methods.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "method/method.h"

namespace lkao::method {

// In the order in which the user reads them.
const std::vector<MethodKind>& method_kinds();
std::vector<std::string> method_words();

// Throws std::invalid_argument, naming the known words, for another one.
const MethodKind& method_named(std::string_view word);
// The library's own, which is the default.
const MethodKind& traversal();
// What a method is checked against: Embree, which is checked against the traversal.
const MethodKind& reference_of(const MethodKind& kind);

std::vector<std::string> words_of_methods_with(const Setting& setting);

}  // namespace lkao::method
