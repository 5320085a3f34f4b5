#version 450 core
// The culling pre-pass: the occlusion of one pixel of each tile, by few samples.
//
// Based on: J. Boksansky, A. Pospisil, J. Bittner, "VAO++: Practical Volumetric Ambient Occlusion for Games",
// EGSR 2017, Sec. 4.2.
#include "gpu/screen/vao/line_samples.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, r32f) writeonly uniform image2D tiles;

const int kSampleCount = 8;

void main() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  if (tile.x >= pass.tile_columns || tile.y >= pass.tile_rows) return;
  ivec2 pixel = min(LKAO_VAO_TILE * tile + LKAO_VAO_TILE / 2, ivec2(view.width, view.height) - 1);
  vec4 position = receiver_position(pixel);
  float value = -1.0;  // nothing is known of the tile
  if (position.w > 0.0) {
    Ball ball = ball_at(position.xyz, receiver_normal(pixel));
    // Tiles turn as pixels do, so that the nine that are asked together look at nine times as many places.
    value = occlusion_of(pipes_of(ball, set_samples(tile, kSampleCount)));
  }
  imageStore(tiles, tile, vec4(value, 0, 0, 0));
}
