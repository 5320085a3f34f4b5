#version 450 core
// One direction of the cross-bilateral filter.
#include "gpu/frame/target.glsl"
#include "gpu/screen/filter.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (is_outside(pixel)) return;
  Surface middle, other;
  if (!find_surface(pixel, middle)) {
    write_background(pixel);
    return;
  }
  float width = pixel_width(middle.position);
  float sum = read_occlusion(pixel), weight_sum = 1.0;
  for (int i = -pass.radius; i <= pass.radius; ++i) {
    ivec2 place = pixel + i * ivec2(pass.step_x, pass.step_y);
    if (i == 0 || any(lessThan(place, ivec2(0))) || is_outside(place) || !find_surface(place, other)) continue;
    float weight = exp(-pass.gauss * float(i * i)) * likeness(middle, other, width);
    sum += weight * read_occlusion(place);
    weight_sum += weight;
  }
  write_occlusion(pixel, sum / weight_sum);
}
