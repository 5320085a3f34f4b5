// One cell of the speed comparison: a scene, a radius, a ray count, an instruction set and a number of threads,
// measured by every method.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/compared_isas.h"
#include "bench/contest.h"
#include "lkao/ambient_occlusion.h"
#include "reference/embree_reference.h"
#include "reference/embree_scene.h"

namespace lkao::bench {

// Method names of lkao; Embree's are those of EmbreeMode.
inline constexpr const char* kSimdMethod = "lkao_simd";      // batches
inline constexpr const char* kSingleMethod = "lkao_single";  // the same kernel, one receiver a call
inline constexpr const char* kAroundMethod = "lkao_around";  // the same, from a Neighbourhood of 64 receivers
inline constexpr const char* kScalarMethod = "lkao_scalar";

// Groups of cells: whether rays end inside the scene.
inline constexpr const char* kBounded = "bounded";
inline constexpr const char* kUnbounded = "unbounded";

struct Cell {
  std::string scene;
  float radius = 0;
  std::string group;
  int ray_count = 0;
  ComparedIsa isa;
  int thread_count = 0;
  std::vector<MethodResult> results;  // lkao's methods, then Embree's modes

  const MethodResult& simd() const { return results[0]; }
  const MethodResult& single() const { return results[1]; }
  const MethodResult& around() const { return results[2]; }
  // Null where it was not measured.
  const MethodResult* scalar() const;
  const MethodResult& best_embree() const;
  // The better of the two flags.
  const MethodResult& occluded1() const;
};

struct CellInput {
  const OccluderBvh* occluders;
  const reference::EmbreeScene* rival;  // not robust, limited to the cell's instruction set
  const reference::EmbreeReference* oracle;
  std::span<const Receiver> receivers;  // two-sided, none excludes a primitive
};

struct MeasureOptions {
  int round_count = 5;
  std::vector<int> thread_counts = {1};
};

// A copy of `question` with results for each number of threads. All methods are measured in turn, round after round,
// each answer the second time it is given, when the caches hold what the method needs. With `with_scalar`, the first
// cell has the scalar kernel too, in the first round only: it knows no instruction sets, and takes long. Leaves the
// cell's instruction set forced.
std::vector<Cell> measure(const CellInput& input, const MeasureOptions& options, const Cell& question,
                          bool with_scalar);

}  // namespace lkao::bench
