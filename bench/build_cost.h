// What it costs to build a hierarchy once: lkao's, and Embree's scene of the same mesh.
#pragma once

#include <cstddef>
#include <optional>

#include "lkao/occluder_bvh.h"
#include "method/words.h"

namespace lkao::bench {

// `refer`: to the host's arrays, without a copy of the mesh.
enum class BuildMethod { lkao, lkao_no_splits, lkao_refer, lkao_refer_no_splits, embree_high, embree_medium };

inline constexpr method::Word<BuildMethod> kBuildMethodWords[] = {
    {"lkao", BuildMethod::lkao},
    {"lkao_no_splits", BuildMethod::lkao_no_splits},
    {"lkao_refer", BuildMethod::lkao_refer},
    {"lkao_refer_no_splits", BuildMethod::lkao_refer_no_splits},
    {"embree_high", BuildMethod::embree_high},
    {"embree_medium", BuildMethod::embree_medium}};

struct BuildCost {
  double seconds;      // on the clock
  double cpu_seconds;  // of all threads together: what a busy machine does not change
  // Of what is left when the build is done, all that queries need. It includes the mesh: lkao keeps a copy or none,
  // Embree its vertex and index buffers.
  std::size_t memory_bytes;
  std::size_t mesh_bytes;                               // of the copy or the buffers alone
  std::optional<OccluderBvh> occluders = std::nullopt;  // of lkao's methods
};

// On the threads of the caller's TBB arena. Throws std::runtime_error with one line.
BuildCost build_once(BuildMethod method, const TriangleMesh& mesh);

}  // namespace lkao::bench
