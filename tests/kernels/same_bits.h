// One question to all kernels: the scalar kernel's answer is right, and nobody may differ from it.
#pragma once

#include <cstdint>
#include <vector>

#include "lkao/lkao.h"
#include "support/meshes.h"

namespace lkao::tests {

struct Question {
  std::vector<OccluderLevel> levels;
  SamplePattern pattern;
  RayOptions options;
  std::vector<Receiver> receivers;  // receiver k has index k
};

// Expects the masks of the scalar kernel from the SIMD kernel on every instruction set: one by one, and in batches of
// 1, of 16 neighbours and of all. The smaller a batch, the closer it looks at what is out of reach of all its
// receivers. Returns the number of rays that are blocked, for callers to see that there was something to be found.
std::uint64_t expect_scalar_bits(const Question& question);

// The same for whole rays, and the scalar kernel itself against every triangle tried.
std::uint64_t expect_same_bits(const Mesh& mesh, const SamplePattern& pattern, const RayOptions& options,
                               const std::vector<Receiver>& receivers, const BuildOptions& build = {});

}  // namespace lkao::tests
