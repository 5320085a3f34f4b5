#include "bench/compared_isas.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lkao/isa.h"

namespace lkao::bench {
namespace {

constexpr const char* kAvx512 = "avx512";

// lkao tells generations of AVX-512 apart, Embree does not.
bool is_avx512(const std::string& isa) { return isa.starts_with("avx3") || isa.starts_with("avx10"); }

std::string embree_config(const std::string& isa) {
  if (is_avx512(isa)) return "isa=avx512";
  if (isa == "avx2") return "isa=avx2";
  if (isa == "sse4") return "isa=sse4.2";
  return {};
}

// Empty where the processor does not have it.
std::string lkao_isa(const std::string& name) {
  for (const std::string& isa : available_isas()) {  // best first
    if (isa == name || (name == kAvx512 && is_avx512(isa))) return isa;
  }
  return {};
}

ComparedIsa compared(const std::string& name) {
  const std::string isa = lkao_isa(name);
  if (isa.empty()) {
    throw std::invalid_argument(fmt::format("--isa: unknown instruction set '{}'; this processor has {}", name,
                                            fmt::join(available_isas(), ", ")));
  }
  return {name, isa, embree_config(isa)};
}

std::vector<std::string> default_names() {
  if (active_isa() != available_isas().front()) return {active_isa()};
  std::vector<std::string> names;
  for (const char* name : {kAvx512, "avx2", "sse4"}) {
    if (!lkao_isa(name).empty()) names.emplace_back(name);
  }
  return names.empty() ? std::vector{active_isa()} : names;
}

}  // namespace

std::vector<ComparedIsa> compared_isas(const std::vector<std::string>& names) {
  std::vector<ComparedIsa> isas;
  for (const std::string& name : names.empty() ? default_names() : names) isas.push_back(compared(name));
  return isas;
}

}  // namespace lkao::bench
