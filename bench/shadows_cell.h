// One cell of the comparison of soft shadows: a scene, a light and a ray count, by every method.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/rays_cell.h"
#include "lkao/soft_shadows.h"

namespace lkao::bench {

// The batch of SoftShadows.
inline constexpr const char* kShadowsMethod = "lkao_shadows";
// The same, one receiver a call.
inline constexpr const char* kSingleShadowsMethod = "lkao_single";

struct ShadowsCell {
  std::string scene;
  std::string light;   // its kind
  float light_radius;  // in the unit of the scene
  int ray_count = 0;
  ComparedIsa isa = {};
  int thread_count = 1;
  std::vector<MethodResult> results = {};  // lkao's batch, lkao's single queries, then Embree's modes
  double lit_share = 0;    // of the receivers, those that see all of the light that is above the horizon
  double umbra_share = 0;  // ... nothing of it
  double mae = 0;          // of visibility, against robust Embree with the same rays

  const MethodResult& batch() const { return results[0]; }
  const MethodResult& single() const { return results[1]; }
  const MethodResult& best_embree() const;
};

// A copy of `question` for every thread count, with results; rounds as measure() of rays_cell.h.
std::vector<ShadowsCell> measure_shadows(const CellInput& input, const AreaLight& light, const MeasureOptions& options,
                                         const ShadowsCell& question);

}  // namespace lkao::bench
