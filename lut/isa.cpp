#include "lut/isa.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hwy/highway.h>

#include "lkao/isa.h"

namespace lkao {
namespace {

std::string name_of(std::int64_t target) {
  std::string name = hwy::TargetName(target);
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  return name;
}

// Best first: Highway gives better targets lower bits. What is forced does not hide the others.
std::vector<std::int64_t> available_targets() {
  static const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  return targets;
}

void use(std::int64_t targets) {
  hwy::SetSupportedTargetsForTest(targets);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace

std::vector<std::string> available_isas() {
  std::vector<std::string> names;
  for (std::int64_t target : available_targets()) names.push_back(name_of(target));
  return names;
}

std::string active_isa() {
  lut::obey_isa_environment();
  return name_of(hwy::SupportedAndGeneratedTargets().front());
}

void force_isa(const std::string& name) {
  const std::string wanted = name == "avx512" ? "avx3" : name;
  const std::vector<std::int64_t> targets = available_targets();
  if (wanted.empty()) return use(0);
  for (std::int64_t target : targets) {
    if (name_of(target) == wanted) return use(target);
  }
  throw std::invalid_argument(
      fmt::format("unknown instruction set {}; this processor has {}", name, fmt::join(available_isas(), ", ")));
}

namespace lut {

void obey_isa_environment() {
  static const bool obeyed = [] {
    if (const char* name = std::getenv("LKAO_ISA")) force_isa(name);
    return true;
  }();
  static_cast<void>(obeyed);
}

}  // namespace lut
}  // namespace lkao
