#version 450 core
// Volumes by vertex pulling.
#include "gpu/volumes/volume.glsl"
#include "gpu/volumes/pass_on.glsl"
#include "gpu/mesh/pull.glsl"

void main() {
  uint triangle;
  int vertex;
  if (!find_triangle(LKAO_VOLUME_VERTEX_COUNT, LKAO_DRAW_PRISM_ARRAYS, triangle, vertex)) {
    gl_Position = vec4(0, 0, 0, 1);
    return;
  }
  Occluder o = fetch_occluder(triangle);
  Volume v = make_volume(o, triangle);
  gl_Position = volume_vertex(v, vertex);
  pass_on(o, v);
}
