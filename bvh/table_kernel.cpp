#include "bvh/table_kernel.h"

#include "bvh/box_outline.h"
#include "bvh/ray_triangle.h"
#include "bvh/table_lookup.h"
#include "bvh/traversal.h"
#include "bvh/triangle_culls.h"

namespace lkao::bvh {
namespace {

class TableKernel {
 public:
  TableKernel(const Query& query, const PlaneMaskTable& table, NodeMasks node_masks)
      : query_(query),
        word_count_(query.rays.word_count()),
        lookup_(table, query.rays.frame, query.radius),
        node_masks_(node_masks) {}

  OcclusionMask node_mask(const Bounds& box, OcclusionMask mask) const {
    if (node_masks_ == NodeMasks::bounding_sphere) {
      keep_towards_sphere(box, mask);
    } else {
      keep_towards_outline(box, mask);
    }
    return mask;
  }

  OcclusionMask triangle_mask(const Layout& layout, const Query& query, std::uint32_t primitive,
                              const OcclusionMask& mask) const {
    OcclusionMask blocked;
    const Corners corners = corners_of(layout, primitive, query);
    if (is_culled(corners.a, corners.b, corners.c, query)) return blocked;
    const TriangleTest test = make_test(layout, primitive, query);
    if (!test.can_block()) return blocked;
    MaskBounds bounds = look_up(test, mask);
    if (has_holes(layout, primitive)) bounds.must = OcclusionMask();
    blocked = bounds.must;
    for_each_ray(bounds.may & ~bounds.must, word_count_, [&](int ray) {
      if (blocks(test, layout, primitive, query, ray)) blocked.set(ray);
    });
    return blocked;
  }

 private:
  // Figure 1: three edges and the triangle's own plane.
  MaskBounds look_up(const TriangleTest& test, const OcclusionMask& mask) const {
    MaskBounds bounds{mask, mask};
    for (int edge = 0; edge < 3; ++edge) {
      if (test.has_edge_direction(edge)) {
        lookup_.keep_beyond_edge(test.edge(edge), bounds);
      } else if (lookup_.has_bounds()) {
        bounds.must = OcclusionMask();
      }
    }
    if (test.has_normal_direction()) {
      lookup_.keep_beyond(test.normal(), test.distance(), bounds);
    } else if (lookup_.has_bounds()) {
      bounds.must = OcclusionMask();
    }
    if (query_.parts != nullptr) drop_beginning_beyond(test, bounds);
    return bounds;
  }

  // Sec. 4.3. All parts of the rays begin at one distance and end with the rays.
  void drop_beginning_beyond(const TriangleTest& test, MaskBounds& bounds) const {
    const float near = query_.parts->near;
    if (test.has_normal_direction_at(near)) {
      lookup_.drop_beyond(test.normal(), test.distance(), static_cast<double>(near), bounds);
    } else if (lookup_.has_bounds()) {
      bounds.must = OcclusionMask();
    }
  }

  // Sec. 5, Figure 4. Right: the rays within the cone around the sphere. Left: of those, the rays long enough to reach
  // it. Where all rays have full length both are planes at right angles to the axis, and the farther one decides.
  void keep_towards_sphere(const Bounds& box, OcclusionMask& mask) const {
    const glm::dvec3 center = 0.5 * (glm::dvec3(box.lower) + glm::dvec3(box.upper)) - glm::dvec3(query_.rays.origin);
    const glm::dvec3 half = 0.5 * (glm::dvec3(box.upper) - glm::dvec3(box.lower));
    const double distance2 = glm::dot(center, center), radius2 = glm::dot(half, half);
    if (distance2 <= radius2) return;  // the receiver is inside
    const double distance = std::sqrt(distance2), tangent2 = distance2 - radius2;
    const double ray2 = static_cast<double>(query_.radius) * static_cast<double>(query_.radius);
    const double cone = std::sqrt(tangent2) / distance;
    if (!lookup_.has_full_length()) {
      lookup_.keep_towards(center, cone, mask);
      lookup_.keep_beyond(center, distance * (distance - std::sqrt(radius2)), mask);
    } else if (tangent2 <= ray2) {
      lookup_.keep_towards(center, cone, mask);
    } else {
      lookup_.keep_beyond(center, 0.5 * (ray2 + tangent2), mask);
    }
  }

  // Sec. 5: "find the silhouette edges of the node bounding box, as seen from p". The faces that p sees also cut off
  // the rays that end before them.
  void keep_towards_outline(const Bounds& box, OcclusionMask& mask) const {
    const BoxOutline outline(box, query_.rays.origin);
    for (int i = 0; i < outline.edge_count(); ++i) lookup_.keep_beyond_edge(outline.edge(i), mask);
    for (int axis = 0; axis < 3; ++axis) {
      if (outline.sees_face(axis)) lookup_.keep_beyond(outline.face_normal(axis), outline.face_distance(axis), mask);
    }
  }

  const Query& query_;
  int word_count_;
  TableLookup lookup_;
  NodeMasks node_masks_;
};

}  // namespace

OcclusionMask trace_table(const Layout& layout, const Query& query, const PlaneMaskTable& table, NodeMasks node_masks) {
  TableKernel kernel(query, table, node_masks);
  return trace(layout, query, kernel);
}

OcclusionMask trace_table(const SceneLayout& scene, const Query& query, const PlaneMaskTable& table,
                          NodeMasks node_masks) {
  TableKernel kernel(query, table, node_masks);
  return trace(scene, query, kernel);
}

}  // namespace lkao::bvh
