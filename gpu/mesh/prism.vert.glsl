#version 450 core
// Prisms by vertex pulling.
#include "gpu/mesh/prism.glsl"
#include "gpu/mesh/pass_on.glsl"
#include "gpu/mesh/pull.glsl"

void main() {
  uint triangle;
  int vertex;
  if (!find_triangle(LKAO_SHAPE_VERTEX_COUNT, LKAO_DRAW_PRISM_ARRAYS, triangle, vertex)) {
    gl_Position = vec4(0, 0, 0, 1);
    return;
  }
  Occluder o = fetch_occluder(triangle);
  gl_Position = prism_vertex(o, vertex);
  pass_on(o);
}
