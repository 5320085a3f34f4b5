#version 450 core
// For each triangle: can it block anything, its normal and bounding sphere, and which shape bounds its influence. Fills
// the lists of triangles and the draw commands, so that a mesh that moves costs nothing on the CPU.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 4.1.
#include "gpu/frame/limits.h"
#include "gpu/mesh/extent.glsl"
#include "gpu/mesh/range.glsl"

layout(local_size_x = LKAO_GROUP_SIZE) in;

layout(binding = LKAO_UNIT_POSITIONS) uniform samplerBuffer positions;
layout(binding = LKAO_UNIT_TRIANGLES) uniform usamplerBuffer triangles;
layout(std430, binding = LKAO_STORAGE_DRAWS) buffer Draws { uint draws[]; };
layout(std430, binding = LKAO_STORAGE_PRISMS) writeonly buffer Prisms { uint prisms[]; };
layout(std430, binding = LKAO_STORAGE_BILLBOARDS) writeonly buffer Billboards { uint billboards[]; };
layout(std430, binding = LKAO_STORAGE_FRAMES) writeonly buffer Frames { vec4 frames[]; };
layout(std430, binding = LKAO_STORAGE_LARGEST) buffer Largest { uint largest_bits; };  // of a float
layout(std430, binding = LKAO_STORAGE_OPACITIES) readonly buffer Opacities { float opacities[]; };

// (b - a) x (c - a) as bvh::area_vector has it: zero where the corners lie on one line.
dvec3 area_vector(dvec3 a, dvec3 b, dvec3 c) {
  precise dvec3 u = b - a, v = c - a;
  precise dvec3 area = dvec3(u.y * v.z - v.y * u.z, u.z * v.x - v.z * u.x, u.x * v.y - v.x * u.y);
  return area;
}

// The centre of the smallest sphere around the triangle.
vec3 sphere_center(dvec3 a, dvec3 b, dvec3 c, dvec3 area) {
  dvec3 u = b - a, v = c - a, w = c - b;
  if (dot(u, v) <= 0.0lf) return vec3(0.5lf * (b + c));
  if (dot(u, w) >= 0.0lf) return vec3(0.5lf * (a + c));
  if (dot(v, w) <= 0.0lf) return vec3(0.5lf * (a + b));
  return vec3(a + (dot(v, v) * cross(area, u) + dot(u, u) * cross(v, area)) / (2.0lf * dot(area, area)));
}

float largest_component(vec3 v) { return max(abs(v.x), max(abs(v.y), abs(v.z))); }

// Takes the next place of the list whose draw commands start at `arrays`.
uint next_place(uint arrays, uint elements) {
  uint index = atomicAdd(draws[arrays], 1u);
  if (index % LKAO_BATCH_SIZE == 0u) atomicAdd(draws[elements + 1u], 1u);
  return index;
}

void main() {
  uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  uint triangle = group * LKAO_GROUP_SIZE + gl_LocalInvocationID.x;
  if (triangle >= uint(textureSize(triangles))) return;
  uvec3 corners = texelFetch(triangles, int(triangle)).xyz;
  vec3 a = texelFetch(positions, int(corners.x)).xyz, b = texelFetch(positions, int(corners.y)).xyz,
       c = texelFetch(positions, int(corners.z)).xyz;
  // Written so that a NaN fails.
  vec3 largest = vec3(largest_component(a), largest_component(b), largest_component(c));
  if (!(all(lessThanEqual(abs(a), vec3(LKAO_LARGEST_COORDINATE))) &&
        all(lessThanEqual(abs(b), vec3(LKAO_LARGEST_COORDINATE))) &&
        all(lessThanEqual(abs(c), vec3(LKAO_LARGEST_COORDINATE))))) {
    return;
  }
  dvec3 area = area_vector(a, b, c);
  if (area == dvec3(0.0lf)) return;
  atomicMax(largest_bits, floatBitsToUint(max(largest.x, max(largest.y, largest.z))));
  if (shapes.is_unbounded != 0) {
    include_point(kOccluders, a);
    include_point(kOccluders, b);
    include_point(kOccluders, c);
  }

  vec2 range = range_of(triangle);
  if (range.x >= range.y) return;  // it counts nowhere, or no ray is that long
  vec3 center = sphere_center(a, b, c, area);
  float size = max(distance(center, a), max(distance(center, b), distance(center, c)));
  float reach = size + shapes.reach * range.y, center_depth = distance_along_view(center);
  // Receivers are in front of a perspective camera.
  if (is_perspective() && center_depth < -1.1 * reach) return;

  frames[2u * triangle] = vec4(vec3(area / sqrt(dot(area, area))), size);
  frames[2u * triangle + 1u] = vec4(center, shapes.has_opacities != 0 ? opacities[triangle] : 1.0);
  // A sphere has an outline only as seen from outside: well outside of the enlarged one that the billboard is made for.
  bool is_inside = is_perspective() && distance(center, view.eye.xyz) < 1.2 * reach;
  if (size > shapes.billboard_threshold * range.y || is_inside) {
    prisms[next_place(LKAO_DRAW_PRISM_ARRAYS, LKAO_DRAW_PRISM_ELEMENTS)] = triangle;
  } else {
    billboards[next_place(LKAO_DRAW_BILLBOARD_ARRAYS, LKAO_DRAW_BILLBOARD_ELEMENTS)] = triangle;
  }
}
