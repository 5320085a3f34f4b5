#version 450 core
// Volumes by the geometry shader, as in the paper (McGuire 2010, step 4): its quadrilaterals as strips.
#include "gpu/volumes/volume.glsl"
#include "gpu/volumes/pass_on.glsl"

layout(points) in;
layout(triangle_strip, max_vertices = 14) out;
flat in uint triangle[];

// Both ends, then the three sides; fronts outwards.
const int kStrips[14] = int[14](0, 2, 1, 3, 4, 5, 3, 0, 4, 1, 5, 2, 3, 0);

void main() {
  Occluder o = fetch_occluder(triangle[0]);
  Volume v = make_volume(o, triangle[0]);
  vec4 vertices[LKAO_VOLUME_VERTEX_COUNT];
  for (int i = 0; i < LKAO_VOLUME_VERTEX_COUNT; ++i) vertices[i] = volume_vertex(v, i);
  for (int i = 0; i < 14; ++i) {
    gl_Position = vertices[kStrips[i]];
    pass_on(o, v);
    EmitVertex();
    if (i == 2 || i == 5) EndPrimitive();
  }
}
