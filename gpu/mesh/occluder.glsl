// A triangle as the shapes and the fragments need it.
#include "gpu/frame/position_error.glsl"
#include "gpu/mesh/depth.glsl"
#include "gpu/mesh/range.glsl"

layout(binding = LKAO_UNIT_POSITIONS) uniform samplerBuffer positions;
layout(binding = LKAO_UNIT_TRIANGLES) uniform usamplerBuffer triangles;
layout(binding = LKAO_UNIT_FRAMES) uniform samplerBuffer frames;
layout(binding = LKAO_UNIT_LIST) uniform usamplerBuffer list;
layout(binding = LKAO_UNIT_DRAWS) uniform usamplerBuffer draws;
layout(binding = LKAO_UNIT_LARGEST) uniform samplerBuffer largest_coordinate;

struct Occluder {
  vec3 a, b, c;
  vec3 normal;   // unit length, precise even for slivers
  vec4 sphere;   // the smallest around it
  vec2 depths;   // of its corners along the view: nearest and farthest
  vec2 range;    // the distances at which it counts
  float opacity; // how much of what it covers it blocks
};

Occluder fetch_occluder(uint triangle) {
  uvec3 corners = texelFetch(triangles, int(triangle)).xyz;
  Occluder o;
  o.a = texelFetch(positions, int(corners.x)).xyz;
  o.b = texelFetch(positions, int(corners.y)).xyz;
  o.c = texelFetch(positions, int(corners.z)).xyz;
  vec4 frame = texelFetch(frames, int(2u * triangle));
  o.normal = frame.xyz;
  vec4 center = texelFetch(frames, int(2u * triangle + 1u));
  o.sphere = vec4(center.xyz, frame.w);
  o.opacity = center.w;
  o.range = range_of(triangle);
  vec3 depths = vec3(distance_along_view(o.a), distance_along_view(o.b), distance_along_view(o.c));
  o.depths = vec2(min(depths.x, min(depths.y, depths.z)), max(depths.x, max(depths.y, depths.z)));
  return o;
}

// By how much a shape is larger than the influence region, so that rounding loses no pixel: of the radius, of
// coordinates and the surface offset, and of a pixel, since rasterisers put corners on a grid of 1/256 pixel.
float margin_of(Occluder o) {
  float largest = texelFetch(largest_coordinate, 0).x, in_play = largest + 2.0 * ao_radius();
  float last = o.depths.y + o.range.y, far = is_perspective() ? max(last, 0.0) : 1.0;
  float margin = 1e-3 * o.range.y + (2.0 * shapes.relative_surface_offset + 8e-7) * in_play +
                 view.pixel_size * far / 32.0;
  if (shapes.is_offset_automatic == 0) return margin;
  // Receivers that start farther off the surface may be farther away by as much.
  float farthest = 1.01 * max(last, o.range.y - o.depths.x) + o.range.y;
  return margin + min(1.01 * largest_error(farthest, in_play), largest_added_offset());
}

vec4 to_clip(vec3 position) { return shapes.clip_from_world * vec4(position, 1.0); }

// The same place on the screen, at one depth.
vec4 to_clip_at(vec3 position, float along_view) {
  vec4 clip = to_clip(position);
  return vec4(clip.xy, depth_at(along_view) * clip.w, clip.w);
}
