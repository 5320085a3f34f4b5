// From triangles to the leaf that answers for them.
#pragma once

#include <cstdint>
#include <span>

#include "bvh/hole_grids.h"
#include "bvh/layout.h"
#include "lkao/cut_outs.h"

namespace lkao::bvh {

// The leaf of 1 to 4 different triangles of the mesh, none of zero area.
//
// Each triangle becomes an affine frame, as in D. Baldwin, M. Weber, "Fast Ray-Triangle Intersections by Coordinate
// Transformation", JCGT 5(3), 2016: a point x has the barycentric coordinates u = u_gradient . (x - vertex) and
// v = v_gradient . (x - vertex), and lies as far behind the plane as back_normal . (x - vertex). Along all rays of a
// receiver the origin's three numbers are the same, so a ray costs three dot products and a triangle next to nothing.
//
// Of the three corners, `vertex` is the one opposite the longest edge: the third coordinate 1 - u - v is then no
// steeper than twice the others, and keeps their precision.
//
// Of those with holes it is the first of the mesh, so that (u, v) is the place that the holes are asked about. `grids`
// of the same holes, or null.
Leaf make_leaf(const PackedMesh& mesh, std::span<const std::uint32_t> primitives, const CutOuts& cut_outs = {},
               const HoleGrids* grids = nullptr);

}  // namespace lkao::bvh
