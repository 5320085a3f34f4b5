#version 450 core
// Prisms by the geometry shader, as in the paper (Laine & Karras 2010, Sec. 4).
#include "gpu/mesh/prism.glsl"
#include "gpu/mesh/pass_on.glsl"

layout(points) in;
layout(triangle_strip, max_vertices = 24) out;
flat in uint triangle[];

void main() {
  Occluder o = fetch_occluder(triangle[0]);
  vec4 vertices[LKAO_SHAPE_VERTEX_COUNT];
  for (int i = 0; i < LKAO_SHAPE_VERTEX_COUNT; ++i) vertices[i] = prism_vertex(o, i);
  for (int i = 0; i < 24; ++i) {
    gl_Position = vertices[kPrismStrips[i]];
    pass_on(o);
    EmitVertex();
    if (i % 12 == 11) EndPrimitive();
  }
}
