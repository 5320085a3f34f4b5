// How near what the pass drew is to the CPU's query.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "lkao/gl.h"
#include "lkao/occluder_bvh.h"
#include "lkao/sample_pattern.h"

namespace moving_mesh {

// Of the pixels that show something, once the query's occlusion is rounded to 8 bits.
struct Difference {
  std::size_t receiver_count = 0;
  double equal_share = 0;
  double mean_error = 0;  // of occlusion in [0, 1]
};

// `resolved`: a byte for every pixel of the pass's last draw(), row by row from y = 0.
Difference compare_with_query(lkao::gl::MaskPass& pass, const lkao::TriangleMesh& mesh,
                              const lkao::SamplePattern& pattern, const lkao::RayOptions& options,
                              std::span<const std::uint8_t> resolved);

}  // namespace moving_mesh
