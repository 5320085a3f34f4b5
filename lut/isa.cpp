#include "lut/isa.h"

#include <algorithm>
#include <atomic>
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

// Best first: Highway gives better targets lower bits.
std::vector<std::int64_t> available_targets() {
  static const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  return targets;
}

// 0: nothing is forced.
std::atomic<std::int64_t> forced_target = 0;

void use(std::int64_t target) {
  forced_target = target;
  lut::chosen_target().Update(target != 0 ? target : hwy::SupportedTargets());
}

}  // namespace

std::vector<std::string> available_isas() {
  std::vector<std::string> names;
  for (std::int64_t target : available_targets()) names.push_back(name_of(target));
  return names;
}

std::string active_isa() {
  lut::obey_isa_environment();
  const std::int64_t target = forced_target;
  return name_of(target != 0 ? target : available_targets().front());
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

hwy::ChosenTarget& chosen_target() {
  static struct Target : hwy::ChosenTarget {
    Target() { Update(hwy::SupportedTargets()); }
  } target;
  return target;
}

void obey_isa_environment() {
  static const bool obeyed = [] {
    if (const char* name = std::getenv("LKAO_ISA")) force_isa(name);
    return true;
  }();
  static_cast<void>(obeyed);
}

}  // namespace lut
}  // namespace lkao
