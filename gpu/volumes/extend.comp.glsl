#version 450 core
// The bases of all volumes, to be kept: as the paper has them where geometry is static (Sec. 5).
#include "gpu/mesh/occluder.glsl"
#include "gpu/volumes/extension.glsl"
#include "gpu/volumes/units.h"
#include "gpu/volumes/volume_pass_block.h"

layout(local_size_x = LKAO_GROUP_SIZE) in;
layout(std430, binding = LKAO_STORAGE_BASES) writeonly buffer Bases { vec4 bases[]; };

void main() {
  uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  uint triangle = group * LKAO_GROUP_SIZE + gl_LocalInvocationID.x;
  if (triangle >= uint(textureSize(triangles))) return;
  Occluder o = fetch_occluder(triangle);
  vec3 base[3];
  extend(o.a, o.b, o.c, o.normal, ao_radius(), pass.clamps_extensions != 0, base);
  for (uint i = 0u; i < 3u; ++i) bases[LKAO_BASE_TEXELS * triangle + i] = vec4(base[i], 0);
}
