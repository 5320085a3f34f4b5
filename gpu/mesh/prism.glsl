// The hexagonal prism around a triangle's influence region.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 4.1 and Figure 2.
#include "gpu/mesh/occluder.glsl"

// The two strips of the prism's 20 triangles, fronts outwards.
const int kPrismStrips[24] = int[24](6, 7, 11, 8, 10, 9, 4, 3, 5, 2, 0, 1, 10, 4, 11, 5, 6, 0, 7, 1, 8, 2, 9, 3);

// Figure 2 at one corner: the line at `radius` across the bisector meets the two edges' lines, moved out by `radius`,
// in two points; `side` is -1 for that on the edge that comes in, +1 for that on the edge that goes out.
vec3 base_point(vec3 previous, vec3 corner, vec3 next, vec3 normal, float radius, float side) {
  vec3 in_edge = normalize(corner - previous), out_edge = normalize(next - corner);
  vec3 in_normal = cross(in_edge, normal), out_normal = cross(out_edge, normal);
  // Both sums point outwards along the bisector; one is long where the other is short.
  vec3 outwards = normalize((in_normal + out_normal) + (in_edge - out_edge));
  float half_sine = dot(in_normal, outwards), half_cosine = dot(in_edge, outwards);
  float sideways = max(half_cosine, 0.0) / (1.0 + max(half_sine, 0.0));
  return corner + radius * (outwards + side * sideways * cross(normal, outwards));
}

// Vertex 0 to 11: the base, counter-clockwise about the normal, then the cover.
vec4 prism_vertex(Occluder o, int vertex) {
  float margin = margin_of(o), radius = o.range.y + margin;
  int corner = vertex % 6 / 2;
  float side = (vertex & 1) == 0 ? -1.0 : 1.0;
  vec3 place = corner == 0   ? base_point(o.c, o.a, o.b, o.normal, radius, side)
               : corner == 1 ? base_point(o.a, o.b, o.c, o.normal, radius, side)
                             : base_point(o.b, o.c, o.a, o.normal, radius, side);
  // "For one-sided triangles, we offset the base of the prism slightly inside the surface."
  float base = is_two_sided() ? -radius : -margin;
  place += o.normal * (vertex < 6 ? base : radius);
  // No point of the prism is twice the radius from the triangle. Where it comes close to the plane of the eye, or
  // behind it, interpolated depths mean nothing: then all of it is as far as its farthest point.
  float near = o.depths.x - 2.0 * radius, far = o.depths.y + 2.0 * radius;
  bool is_flat = is_perspective() && near < 1e-3 * far;
  return is_flat ? to_clip_at(place, far) : to_clip(place);
}
