#version 450 core
// Billboards by vertex pulling.
#include "gpu/mesh/billboard.glsl"
#include "gpu/mesh/pass_on.glsl"
#include "gpu/mesh/pull.glsl"

void main() {
  uint triangle;
  int vertex;
  if (!find_triangle(2 * LKAO_SHAPE_VERTEX_COUNT, LKAO_DRAW_BILLBOARD_ARRAYS, triangle, vertex)) {
    gl_Position = vec4(0, 0, 0, 1);
    return;
  }
  Occluder o = fetch_occluder(triangle);
  gl_Position = billboard_vertex(o, vertex / LKAO_SHAPE_VERTEX_COUNT, vertex % LKAO_SHAPE_VERTEX_COUNT);
  pass_on(o);
}
