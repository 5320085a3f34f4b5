// Where segments lie that begin in one box and end in another.
//
// Based on: E. Haines, J. Wallace, "Shaft Culling for Efficient Ray-Traced Radiosity", Eurographics Workshop on
// Rendering 1991: the convex hull of two boxes as the box around both, cut by planes through their edges.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <glm/common.hpp>

#include "bvh/layout.h"
#include "lkao/occluder_bvh.h"

namespace lkao::bvh {

class Shaft {
 public:
  // Neither box may be empty.
  Shaft(const Bounds& origins, const Bounds& ends)
      : around_{glm::min(origins.lower, ends.lower), glm::max(origins.upper, ends.upper)} {
    for (int a = 0; a < 3; ++a) {
      for (int corner = 0; corner < 4; ++corner) add_plane(origins, ends, a, (a + 1) % 3, corner);
    }
  }

  // Children of the node whose boxes some segment of the shaft may meet, as bits. Conservative: may be too many. Loops
  // over children that compilers make vectors of.
  std::uint32_t met_children(const Node& node) const {
    double beyond[kWidth];  // how far a child is outside of what it is farthest outside of
    std::fill_n(beyond, kWidth, -std::numeric_limits<double>::infinity());
    const auto raise = [&](const auto& by) {
      for (int child = 0; child < kWidth; ++child) {
        const double value = by(child);
        beyond[child] = value > beyond[child] ? value : beyond[child];
      }
    };
    for (int axis = 0; axis < 3; ++axis) {
      const double lower = static_cast<double>(around_.lower[axis]), upper = static_cast<double>(around_.upper[axis]);
      raise([&](int child) { return static_cast<double>(node.faces[0][axis][child]) - upper; });
      raise([&](int child) { return lower - static_cast<double>(node.faces[1][axis][child]); });
    }
    for (int i = 0; i < plane_count_; ++i) {
      const Plane& plane = planes_[i];
      const float* const at_a = node.faces[plane.normal_a > 0 ? 0 : 1][plane.a];
      const float* const at_b = node.faces[plane.normal_b > 0 ? 0 : 1][plane.b];
      raise([&](int child) {
        return plane.normal_a * static_cast<double>(at_a[child]) + plane.normal_b * static_cast<double>(at_b[child]) -
               plane.most;
      });
    }
    std::uint32_t met = 0;
    for (int child = 0; child < kWidth; ++child) met |= static_cast<std::uint32_t>(beyond[child] <= 0) << child;
    return met;
  }

 private:
  // In the space of two axes: outside is where the normal leads farther than `most`.
  struct Plane {
    int a, b;
    double normal_a, normal_b;
    double most;
  };

  static double corner_of(const Bounds& box, int axis, bool is_upper) {
    return static_cast<double>(is_upper ? box.upper[axis] : box.lower[axis]);
  }

  // Along two axes the boxes are rectangles. The line through the same corner of both is a side of the hull where it
  // has both of them on its inner side: where its normal points the way of that corner.
  void add_plane(const Bounds& origins, const Bounds& ends, int a, int b, int corner) {
    const bool upper_a = (corner & 1) != 0, upper_b = (corner & 2) != 0;
    const double from_a = corner_of(origins, a, upper_a), from_b = corner_of(origins, b, upper_b);
    const double along_a = corner_of(ends, a, upper_a) - from_a, along_b = corner_of(ends, b, upper_b) - from_b;
    Plane plane{a, b, along_b, -along_a, 0};
    const auto points = [](double component, bool up) { return up ? component >= 0 : component <= 0; };
    if (!points(plane.normal_a, upper_a) || !points(plane.normal_b, upper_b)) {
      plane.normal_a = -plane.normal_a;
      plane.normal_b = -plane.normal_b;
      if (!points(plane.normal_a, upper_a) || !points(plane.normal_b, upper_b)) return;
    }
    const double size = std::fabs(plane.normal_a) * (std::fabs(from_a) + std::fabs(along_a)) +
                        std::fabs(plane.normal_b) * (std::fabs(from_b) + std::fabs(along_b));
    plane.most = plane.normal_a * from_a + plane.normal_b * from_b + 1e-6 * size;  // rays round in float
    planes_[plane_count_++] = plane;
  }

  Bounds around_;
  int plane_count_ = 0;
  Plane planes_[12];
};

}  // namespace lkao::bvh
