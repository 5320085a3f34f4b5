#version 450 core
// Positions of instances in the world, from those in their meshes' own spaces. In double, rounded once: what the CPU
// gets that multiplies in double.
#include "gpu/mesh/draw_words.h"
#include "gpu/mesh/units.h"

layout(local_size_x = LKAO_GROUP_SIZE) in;

struct Instance {
  vec4 row_x, row_y, row_z;  // of the transform to the world
  uint first_world, first_local;
  uint padding_0, padding_1;
};

layout(std430, binding = LKAO_STORAGE_WORLD) writeonly buffer World { float world[]; };
layout(std430, binding = LKAO_STORAGE_LOCAL) readonly buffer Local { float local[]; };
layout(std430, binding = LKAO_STORAGE_INSTANCES) readonly buffer Instances { Instance instances[]; };

// The last instance that does not begin after the position.
uint instance_of(uint position) {
  uint first = 0u, last = uint(instances.length()) - 1u;
  while (first < last) {
    uint middle = (first + last + 1u) / 2u;
    if (instances[middle].first_world <= position) {
      first = middle;
    } else {
      last = middle - 1u;
    }
  }
  return first;
}

float transformed(vec4 row, dvec3 p) {
  precise double x = double(row.x) * p.x, y = double(row.y) * p.y, z = double(row.z) * p.z;
  precise double sum = x + y + z + double(row.w);
  return float(sum);
}

void main() {
  uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  uint position = group * LKAO_GROUP_SIZE + gl_LocalInvocationID.x;
  if (3u * position >= uint(world.length())) return;
  uint number = instance_of(position);
  uint from = 3u * (instances[number].first_local + position - instances[number].first_world);
  dvec3 p = dvec3(local[from], local[from + 1u], local[from + 2u]);
  world[3u * position] = transformed(instances[number].row_x, p);
  world[3u * position + 1u] = transformed(instances[number].row_y, p);
  world[3u * position + 2u] = transformed(instances[number].row_z, p);
}
