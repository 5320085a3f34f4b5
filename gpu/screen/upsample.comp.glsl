#version 450 core
// From occlusion of every n-th pixel to that of all.
//
// Based on: J. Kopf, M. Cohen, D. Lischinski, M. Uyttendaele, "Joint Bilateral Upsampling", SIGGRAPH 2007, Sec. 3.
#include "gpu/frame/target.glsl"
#include "gpu/screen/filter.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// What a sample on quite another surface still counts: next to nothing beside one on the same, and enough where there
// are no others.
const float kLeastLikeness = 1e-6;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (is_outside(pixel)) return;
  Surface middle, other;
  if (!find_surface(pixel, middle)) {
    write_background(pixel);
    return;
  }
  float width = pixel_width(middle.position);
  float sum = 0.0, weight_sum = 0.0;
  ivec2 last = min((pixel + pass.radius) / pass.sample_step, ivec2(pass.sample_width, pass.sample_height) - 1);
  ivec2 first = (max(pixel - pass.radius, 0) + pass.sample_step - 1) / pass.sample_step;
  for (int y = first.y; y <= last.y; ++y) {
    for (int x = first.x; x <= last.x; ++x) {
      ivec2 place = pass.sample_step * ivec2(x, y);
      if (!find_surface(place, other)) continue;
      vec2 away = vec2(place - pixel);
      float weight = exp(-pass.gauss * dot(away, away)) * (likeness(middle, other, width) + kLeastLikeness);
      sum += weight * read_occlusion(ivec2(x, y));
      weight_sum += weight;
    }
  }
  // Nothing is known of what no sample saw.
  write_occlusion(pixel, weight_sum > 0.0 ? sum / weight_sum : 0.0);
}
