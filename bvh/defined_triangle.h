// The definition (query.h), as the vector kernels ask for it: where they are in doubt.
#pragma once

#include <cstdint>
#include <optional>

#include "bvh/layout.h"
#include "bvh/query.h"
#include "bvh/ray_triangle.h"

namespace lkao::bvh {

// A triangle and rays of a query, one by one, with as little work as each needs.
//
// Nothing of it is inline: GCC 12.2 got answers wrong where the definition was compiled into a function for AVX2, at
// -O3, and right without its vectors from straight code (-fno-tree-slp-vectorize). So it is compiled once, for any
// processor.
class DefinedTriangle {
 public:
  // Must not outlive them.
  DefinedTriangle(const Layout& layout, const Query& query, std::uint32_t primitive)
      : layout_(layout), query_(query), primitive_(primitive) {}

  // TriangleTest::can_block, in_front.
  bool can_block();
  bool is_in_front();
  // Does it block this ray, where that does not go through a hole?
  bool blocks(int ray);
  // The same of a ray that meets a triangle with holes for sure.
  bool blocks_met(int ray);

 private:
  const TriangleTest& test();

  const Layout& layout_;
  const Query& query_;
  std::uint32_t primitive_;
  std::optional<TriangleTest> test_;  // made for the first ray that needs it
};

}  // namespace lkao::bvh
