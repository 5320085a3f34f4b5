#version 450 core
// Billboards by the geometry shader.
#include "gpu/mesh/billboard.glsl"
#include "gpu/mesh/pass_on.glsl"

layout(points) in;
layout(triangle_strip, max_vertices = 24) out;
flat in uint triangle[];

void main() {
  Occluder o = fetch_occluder(triangle[0]);
  int polygon_count = is_two_sided() ? 1 : 2;
  for (int polygon = 0; polygon < polygon_count; ++polygon) {
    for (int i = 0; i < LKAO_SHAPE_VERTEX_COUNT; ++i) {
      gl_Position = billboard_vertex(o, polygon, kPolygonStrip[i]);
      pass_on(o);
      EmitVertex();
    }
    EndPrimitive();
  }
}
