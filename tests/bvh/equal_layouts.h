// Are two hierarchies the same, node by node?
#pragma once

#include <cstddef>
#include <cstring>

#include <gtest/gtest.h>

#include "bvh/layout.h"

namespace lkao::tests {

inline bool are_equal(const bvh::Node& a, const bvh::Node& b) {
  return std::memcmp(a.faces, b.faces, sizeof(a.faces)) == 0 &&
         std::memcmp(a.children, b.children, sizeof(a.children)) == 0;
}

inline bool are_equal(const bvh::Leaf& a, const bvh::Leaf& b) { return std::memcmp(&a, &b, sizeof(bvh::Leaf)) == 0; }

// Of nodes or leaves.
template <typename Vector>
void expect_equal(const Vector& a, const Vector& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_TRUE(are_equal(a[i], b[i])) << i;
}

}  // namespace lkao::tests
