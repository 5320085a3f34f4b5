// One cell of the speed comparison: a scene, a radius and a ray count, measured by every method.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lkao/ambient_occlusion.h"
#include "reference/embree_reference.h"
#include "reference/embree_scene.h"

namespace lkao::bench {

// Method names of lkao's kernels; Embree's are those of EmbreeMode.
inline constexpr const char* kSimdMethod = "lkao_simd";
inline constexpr const char* kScalarMethod = "lkao_scalar";

struct MethodResult {
  std::string method;
  std::string isa;
  double mrays_per_second = 0;  // of rays above the horizon, making them included; the median of the rounds
  double mismatch_rate = 0;     // share of the rays whose answer differs from robust Embree's
};

struct Cell {
  std::string scene;
  float radius = 0;
  int ray_count = 0;
  std::vector<std::string> isas;      // of lkao's SIMD kernel; the first is the one that Embree is compared with
  std::vector<MethodResult> results;  // lkao's kernels, then Embree's modes

  const MethodResult& simd() const { return results.front(); }  // on the first of `isas`
  const MethodResult& scalar() const;
  const MethodResult& best_embree() const;
  // The better of the two flags.
  const MethodResult& occluded1() const;
};

struct CellInput {
  const OccluderBvh* occluders;
  const reference::EmbreeScene* rival;  // not robust
  const reference::EmbreeReference* oracle;
  std::span<const Receiver> receivers;  // two-sided, none excludes a primitive
};

struct MeasureOptions {
  int round_count = 5;
  int thread_count = 1;
};

// Measures all methods in turn, round after round; the scalar kernel in the first round only. Fills `cell.results` for
// its radius, ray count and instruction sets, and leaves the first of these forced.
void measure(const CellInput& input, const MeasureOptions& options, Cell& cell);

}  // namespace lkao::bench
