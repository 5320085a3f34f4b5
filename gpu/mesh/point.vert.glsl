#version 450 core
// A point for each triangle of the list; the geometry shaders make shapes of them.
#include "gpu/mesh/units.h"

layout(binding = LKAO_UNIT_LIST) uniform usamplerBuffer list;
flat out uint triangle;

void main() {
  triangle = texelFetch(list, gl_VertexID).x;
  gl_Position = vec4(0, 0, 0, 1);
}
