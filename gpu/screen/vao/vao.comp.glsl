#version 450 core
// The occlusion of every pixel, and the colours of light that near surfaces send on.
//
// Based on: J. Boksansky, A. Pospisil, J. Bittner, "VAO++: Practical Volumetric Ambient Occlusion for Games",
// EGSR 2017, Sec. 4.
// Differs from the paper:
// - Tiles are culled whole, where they and all eight around show nothing in the way: what the paper's four interpolated
//   fetches look at, or more, and the same for all pixels of a group.
// - A tile whose pixel shows no receiver is not culled: nothing is known of it.
// - Light bleeds from the points that pixels show, not from samples, which may lie deep inside of things.
#include "gpu/frame/target.glsl"
#include "gpu/screen/vao/line_samples.glsl"

layout(local_size_x = LKAO_VAO_TILE, local_size_y = LKAO_VAO_TILE) in;
layout(binding = LKAO_UNIT_VAO_TILES) uniform sampler2D tiles;
layout(binding = LKAO_UNIT_VAO_COLOURS) uniform sampler2D colours;
layout(binding = LKAO_IMAGE_VAO_BLEEDING) writeonly uniform image2D bleeding;

// A tile's occlusion that is no rounding, and less than pictures of 8 bits show.
const float kSomething = 1.0 / 512.0;
const int kCarefulSize = 4;

vec3 colour_at(ivec2 pixel) {
  return texelFetch(colours, ivec2(view.first_x, view.first_y) + view.step * pixel, 0).rgb;
}

bool is_tile_culled(ivec2 tile) {
  if (pass.culling == LKAO_VAO_CULL_NOTHING || texelFetch(tiles, tile, 0).x < 0.0) return false;
  for (int y = max(tile.y - 1, 0); y <= min(tile.y + 1, pass.tile_rows - 1); ++y) {
    for (int x = max(tile.x - 1, 0); x <= min(tile.x + 1, pass.tile_columns - 1); ++x) {
      if (texelFetch(tiles, ivec2(x, y), 0).x > kSomething) return false;
    }
  }
  return true;
}

// EGSR 2017, Sec. 4.1: 2 samples where the ball is as wide as is said, twice as many where its area is twice as large.
int set_size(Ball ball) {
  if (pass.fewest_samples_width == 0.0) return pass.largest_size;
  float width = 2.0 * ball.radius / (pixel_width(ball.centre) * float(min(view.width, view.height)));
  float doublings = floor(2.0 * log2(width / pass.fewest_samples_width));
  return min(2 << int(clamp(doublings, 0.0, 4.0)), pass.largest_size);
}

Samples samples_of(ivec2 pixel, Ball ball, bool is_culled) {
  if (pass.largest_size == 0) return is_culled ? set_samples(pixel, kCarefulSize) : sequence_samples(pixel);
  int size = set_size(ball);
  return set_samples(pixel, is_culled ? min(size, kCarefulSize) : size);
}

// Eq. 3: how much of the occlusion stays.
float kept_by_brightness(vec3 colour) {
  float brightness = pass.uses_value != 0 ? max(colour.r, max(colour.g, colour.b))
                                          : dot(colour, vec3(0.2126, 0.7152, 0.0722));
  float fallen = clamp((brightness - pass.luminance_begin) * pass.luminance_scale, 0.0, 1.0);
  return pow(1.0 - fallen, pass.luminance_sigma);
}

// Eq. 5, and nothing beyond the radius.
float bleeding_from(vec3 to, vec3 normal) {
  float squared = dot(to, to);
  if (!(squared > 0.0 && squared < pass.radius * pass.radius)) return 0.0;
  float distance_to_it = sqrt(squared), left = 1.0 - distance_to_it / pass.radius;
  return max(dot(to, normal) / distance_to_it, 0.0) * left * left;
}

// The mean over the samples of white, mixed with their pixels' colours.
vec3 bled_light(vec3 position, vec3 normal, Ball ball, Samples samples) {
  vec3 sum = vec3(0);
  float count = 0.0;
  for (int i = 0; i < samples.count; i += pass.bleeding_stride) {
    ivec2 pixel = sample_pixel(ball, samples, i);
    if (!is_on_picture(pixel)) continue;
    vec4 seen = receiver_position(pixel);
    float share = seen.w > 0.0 ? bleeding_from(seen.xyz - position, normal) : 0.0;
    sum += share > 0.0 ? mix(vec3(1), colour_at(pixel), share) : vec3(1);
    count += 1.0;
  }
  return count > 0.0 ? sum / count : vec3(1);
}

void write_bleeding(ivec2 pixel, vec3 light) {
  if (pass.bleeding_stride == 0) return;
  imageStore(bleeding, ivec2(pass.bleeding_x, pass.bleeding_y) + pixel,
             at_nearest_step(vec4(light, 1), pass.bleeding_steps));
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (is_outside(pixel)) return;
  vec4 position = receiver_position(pixel);
  if (position.w == 0.0) {
    write_background(pixel);
    write_bleeding(pixel, vec3(1));
    return;
  }
  COUNT_0;
  bool is_culled = is_tile_culled(ivec2(gl_WorkGroupID.xy));
  if (is_culled) {
    COUNT_1;
    if (pass.culling == LKAO_VAO_CULL_GREEDILY) {
      write_occlusion(pixel, 0.0);
      write_bleeding(pixel, vec3(1));
      return;
    }
  }
  vec3 normal = receiver_normal(pixel);
  Ball ball = ball_at(position.xyz, normal);
  Samples samples = samples_of(pixel, ball, is_culled);
  float occlusion = occlusion_of(pipes_of(ball, samples));
  if (pass.luminance_scale > 0.0) occlusion *= kept_by_brightness(colour_at(pixel));
  write_occlusion(pixel, occlusion);
  if (pass.bleeding_stride > 0) write_bleeding(pixel, bled_light(position.xyz, normal, ball, samples));
}
