// Other ways to cast the same rays, for comparison only: Embree where the tools are built, else none.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "lkao/ambient_occlusion.h"
#include "support/meshes.h"

namespace lkao::tests {

struct Rival {
  std::string name;
  std::function<OcclusionMask(const AmbientOcclusion& ao, const Receiver& receiver, std::uint64_t index)> mask;
};

std::vector<Rival> make_rivals(const Mesh& mesh);

}  // namespace lkao::tests
