#include "bvh/defined_triangle.h"

#include "bvh/cut_outs.h"

namespace lkao::bvh {

bool DefinedTriangle::can_block() { return test().can_block(); }

bool DefinedTriangle::is_in_front() { return test().in_front(); }

bool DefinedTriangle::blocks(int ray) {
  return test().can_block() && bvh::blocks(test(), layout_, primitive_, query_, ray);
}

bool DefinedTriangle::blocks_met(int ray) {
  const CutOuts& cut_outs = layout_.options.cut_outs;
  if (!asks_for_places(cut_outs)) {
    return is_blocked_anywhere(cut_outs, query_.instance, primitive_, {query_.key, number_in_world(query_, ray)});
  }
  return blocks_where_met(test(), layout_, primitive_, query_, ray);
}

const TriangleTest& DefinedTriangle::test() {
  if (!test_) test_.emplace(make_test(layout_, primitive_, query_));
  return *test_;
}

}  // namespace lkao::bvh
