// A triangle with holes and the rays of a query that may meet it, one by one, with as little work as each needs.
#pragma once

#include <cstdint>
#include <optional>

#include "bvh/cut_outs.h"
#include "bvh/layout.h"
#include "bvh/query.h"
#include "bvh/ray_triangle.h"

namespace lkao::bvh {

class HoledTriangle {
 public:
  HoledTriangle(const Layout& layout, const Query& query, std::uint32_t primitive)
      : layout_(layout), query_(query), primitive_(primitive) {}

  // Of a ray that may meet it.
  bool blocks(int ray) { return test().can_block() && bvh::blocks(test(), layout_, primitive_, query_, ray); }

  // Of a ray that meets it for sure.
  bool blocks_met(int ray) {
    const CutOuts& cut_outs = layout_.options.cut_outs;
    if (!asks_for_places(cut_outs)) {
      return is_blocked_anywhere(cut_outs, query_.instance, primitive_, {query_.key, number_in_world(query_, ray)});
    }
    return blocks_where_met(test(), layout_, primitive_, query_, ray);
  }

 private:
  const TriangleTest& test() {
    if (!test_) test_.emplace(make_test(layout_, primitive_, query_));
    return *test_;
  }

  const Layout& layout_;
  const Query& query_;
  std::uint32_t primitive_;
  std::optional<TriangleTest> test_;  // made for the first ray that needs it
};

}  // namespace lkao::bvh
