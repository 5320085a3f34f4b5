// The polygons that cover the influence region of a small triangle on the screen.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 4.1 and Figure 3.
#include "gpu/mesh/occluder.glsl"

// The strip of a polygon of 12 corners.
const int kPolygonStrip[12] = int[12](0, 1, 11, 2, 10, 3, 9, 4, 8, 5, 7, 6);
const float kCircumscribe = 1.0352762;  // 1 / cos(pi / 12)
const float kTwelfth = 0.52359878;      // of a turn

// The axes and sizes of the figure, relative to the sphere's centre. The camera looks along `view`; `across` is square
// to both it and the normal, so the separating line runs along it.
struct Hemisphere {
  float radius;        // of the enlarged sphere
  vec3 view, across;
  float view_normal;   // cosine and sine between view and normal
  float view_normal_sine;
  float outline_back;  // the outline's plane is so far in front of the centre
  float base;          // height of the base plane over the centre, along the normal; negative
};

Hemisphere make_hemisphere(Occluder o) {
  float margin = margin_of(o);
  Hemisphere h;
  h.radius = (o.sphere.w + o.range.y + margin) * kCircumscribe;
  if (is_perspective()) {
    vec3 to_center = o.sphere.xyz - view.eye.xyz;
    float far = length(to_center);
    h.view = to_center / far;
    h.outline_back = h.radius * h.radius / far;
  } else {
    h.view = view.eye.xyz;
    h.outline_back = 0.0;
  }
  h.base = -margin;
  h.view_normal = dot(h.view, o.normal);
  vec3 across = cross(h.view, o.normal);
  h.view_normal_sine = max(length(across), 1e-6);
  // Where the view runs along the normal there is no separating line: any direction will do.
  h.across = dot(across, across) > 1e-12
                 ? across / length(across)
                 : normalize(cross(h.view, abs(h.view.x) < 0.5 ? vec3(1, 0, 0) : vec3(0, 1, 0)));
  return h;
}

// The end of the separating line on the side of `side`: where both circles meet. One point for both polygons, bit for
// bit, or pixels would be lost between them. Where the circles do not meet, a point that makes nothing of what is cut
// off.
vec3 line_end(Hemisphere h, float side) {
  float square = h.radius * h.radius - h.outline_back * h.outline_back, radius = sqrt(square);
  float line = clamp((h.base + h.outline_back * h.view_normal) / h.view_normal_sine, -radius, radius);
  float half_line = sqrt(max(square - line * line, 0.0));
  return line * cross(h.across, h.view) + (side < 0.0 ? -half_line : half_line) * h.across - h.outline_back * h.view;
}

// Left of Figure 3: the circle of the sphere's outline, of which the part before the base plane is kept.
vec3 outline_vertex(Hemisphere h, vec2 direction, bool is_whole) {
  vec2 place = direction * sqrt(h.radius * h.radius - h.outline_back * h.outline_back);
  float line = (h.base + h.outline_back * h.view_normal) / h.view_normal_sine;
  if (!is_whole && place.x < line) return line_end(h, place.y);
  return place.x * cross(h.across, h.view) + place.y * h.across - h.outline_back * h.view;
}

// The circle in the base plane, of which the part beyond the separating line is kept.
vec3 base_vertex(Hemisphere h, vec3 normal, vec2 direction) {
  vec2 place = direction * sqrt(h.radius * h.radius - h.base * h.base);
  float line = -(h.outline_back + h.base * h.view_normal) / h.view_normal_sine;
  bool is_kept = h.view_normal < 0.0 ? place.x <= line : place.x >= line;
  if (!is_kept) return line_end(h, place.y);
  return h.base * normal + place.x * cross(normal, h.across) + place.y * h.across;
}

// Vertex 0 to 11 of polygon 0 or 1. Two-sided triangles have only the first, a whole circle.
vec4 billboard_vertex(Occluder o, int polygon, int vertex) {
  Hemisphere h = make_hemisphere(o);
  // Corners come in pairs, one on each side of the figure's axis, so that where any is cut off, both ends of the line
  // stay.
  float turn = kTwelfth * (float(vertex) + 0.5);
  vec2 direction = vec2(cos(turn), sin(turn));
  // "We correct their depth so that the billboard appears to be located just behind the sphere of influence."
  float depth = distance_along_view(o.sphere.xyz) + h.radius;
  // The camera is well outside of the sphere, or this were a prism (classify.comp), but perhaps not of its margin: then
  // there is no outline, and the whole screen will do.
  if (h.outline_back > 0.9 * h.radius) return vec4(2.0 * direction, depth_at(depth), 1.0);
  vec3 place = polygon == 0 ? outline_vertex(h, direction, is_two_sided())
                            : base_vertex(h, o.normal, direction);
  return to_clip_at(o.sphere.xyz + place, depth);
}
