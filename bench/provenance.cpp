#include "bench/provenance.h"

#include <fstream>

#include <fmt/format.h>

#include "commit.h"

namespace lkao::bench {
namespace {

constexpr const char* kUnknown = "unknown";

// Lines are "key<tabs>: value"; the first of a key speaks for all processors.
std::string cpu_info(const std::string& key) {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) continue;
    if (line.substr(0, line.find_last_not_of(" \t", colon - 1) + 1) == key) return line.substr(colon + 2);
  }
  return kUnknown;
}

}  // namespace

Processor processor() { return {cpu_info("model name"), cpu_info("cpu family"), cpu_info("model")}; }

std::string compiler() {
#if defined(__clang__)
  return fmt::format("Clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
  return fmt::format("GCC {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
  return kUnknown;
#endif
}

std::string commit() { return LKAO_COMMIT[0] != '\0' ? LKAO_COMMIT : kUnknown; }

std::string provenance_comment() {
  const Processor p = processor();
  return fmt::format("# processor: {}, CPU family {}, model {}\n# compiler: {}\n# commit: {}\n", p.name, p.family,
                     p.model, compiler(), commit());
}

}  // namespace lkao::bench
