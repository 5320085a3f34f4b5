// A query that a fuzzer's bytes describe: occluders, pattern, options and receivers.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lkao/lkao.h"
#include "support/meshes.h"

namespace lkao::tests {

struct QueryCase {
  // Beyond what answers are exact for: scales of 1e-9 and 1e9, or numbers so far apart (a corner at 1e18, a radius of
  // 1e-18) that the rounding which the definition of a hit allows for reaches past the boxes of triangles.
  bool is_wild = false;
  Mesh mesh;
  BuildOptions build;
  SamplePattern pattern;
  std::string pattern_name;             // for messages
  std::optional<PlaneMaskTable> table;  // of this pattern, with must/may masks, where there is one
  RayOptions options;
  NodeMasks node_masks = NodeMasks::box_outline;  // of the table kernel
  std::vector<Receiver> receivers;
  std::uint64_t first_index = 0;
  float level_end = 0;  // where two levels of detail meet, if it is not 0; then no receiver excludes a primitive
};

// The same bytes, the same case.
QueryCase decode_query_case(std::span<const std::uint8_t> bytes);

}  // namespace lkao::tests
