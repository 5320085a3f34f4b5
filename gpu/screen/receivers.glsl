// The receivers of a picture in view space, one fetch each (gpu/screen/picture.h).
#include "gpu/frame/view.glsl"
#include "gpu/screen/units.h"

layout(binding = LKAO_UNIT_SCREEN_RECEIVERS) uniform sampler2DArray receivers;

// w: 1, or 0 where there is none.
vec4 receiver_position(ivec2 pixel) { return texelFetch(receivers, ivec3(pixel, LKAO_SCREEN_POSITION), 0); }
vec3 receiver_normal(ivec2 pixel) { return texelFetch(receivers, ivec3(pixel, LKAO_SCREEN_NORMAL), 0).xyz; }

bool is_on_picture(ivec2 pixel) { return all(greaterThanEqual(pixel, ivec2(0))) && !is_outside(pixel); }

// Where a point in front of the eye lies: pixel (0, 0) reaches from 0 to 1 along both axes.
vec2 place_on_picture(vec3 position) {
  vec4 clip = view.clip_from_view * vec4(position, 1.0);
  return (0.5 * clip.xy / clip.w + 0.5) * vec2(view.width, view.height);
}
