// Instruction sets that lkao and Embree are both limited to, so that neither is ahead by the processor alone.
#pragma once

#include <string>
#include <vector>

namespace lkao::bench {

struct ComparedIsa {
  std::string name;           // as the option --isa and the figures have it: "avx512", "avx2", "sse4", ...
  std::string lkao;           // for force_isa
  std::string embree_config;  // for rtcNewDevice; empty where Embree has no choice
};

// Those named, in this order. Without names: AVX-512, AVX2 and SSE4 as far as the processor has them, or its best where
// it has none of these; the active one alone where the environment limits lkao. Throws std::invalid_argument naming
// what is not available.
std::vector<ComparedIsa> compared_isas(const std::vector<std::string>& names);

}  // namespace lkao::bench
