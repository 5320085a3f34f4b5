// The ambient occlusion volume of a triangle: where its falloff is above 0. Variant: LKAO_KEPT, bases are read and not
// found.
//
// Based on: M. McGuire, "Ambient Occlusion Volumes", HPG 2010, Sec. 5.2 and Figure 6.
//
// Differs from the paper: the far side of the volume is drawn with an inverted depth test, instead of the near side or,
// where the camera is inside, a rectangle over the whole screen (step 4.iii). Both let receivers through that are not
// inside; the falloff drops them, and where corners are clamped, the fragment's own test: or the view would tell who
// has what falloff is left there. Volumes of two-sided triangles reach as far behind them as before them.
#include "gpu/mesh/occluder.glsl"
#include "gpu/volumes/extension.glsl"
#include "gpu/volumes/units.h"
#include "gpu/volumes/volume_pass_block.h"

#if LKAO_KEPT
layout(binding = LKAO_UNIT_BASES) uniform samplerBuffer bases;
#endif

struct Volume {
  vec3 base[3];    // in the triangle's plane
  vec3 normal;
  vec2 heights;    // of the two ends over that plane
  vec2 depths;     // nearest and farthest along the view
};

Volume make_volume(Occluder o, uint triangle) {
  Volume v;
#if LKAO_KEPT
  for (int i = 0; i < 3; ++i) v.base[i] = texelFetch(bases, LKAO_BASE_TEXELS * int(triangle) + i).xyz;
#else
  extend(o.a, o.b, o.c, o.normal, ao_radius(), pass.clamps_extensions != 0, v.base);
#endif
  v.normal = o.normal;
  // At all other faces the falloff is 0; before the plane it is not, so rounding must lose nothing there.
  v.heights = vec2(is_two_sided() ? -ao_radius() : -margin_of(o), ao_radius());
  vec3 depths = vec3(distance_along_view(v.base[0]), distance_along_view(v.base[1]), distance_along_view(v.base[2]));
  vec2 rise = dot(view.view_depth.xyz, v.normal) * v.heights;
  v.depths = vec2(min(depths.x, min(depths.y, depths.z)) + min(rise.x, rise.y),
                  max(depths.x, max(depths.y, depths.z)) + max(rise.x, rise.y));
  return v;
}

// Vertex 0 to 5: the lower end, counter-clockwise about the normal, then the upper one.
vec4 volume_vertex(Volume v, int vertex) {
  vec3 place = v.base[vertex % 3] + v.normal * (vertex < 3 ? v.heights.x : v.heights.y);
  // Where the volume comes close to the plane of the eye, or behind it, interpolated depths mean nothing: then all of
  // it is as far as its farthest point.
  bool is_flat = is_perspective() && v.depths.x < 1e-3 * v.depths.y;
  return is_flat ? to_clip_at(place, v.depths.y) : to_clip(place);
}
