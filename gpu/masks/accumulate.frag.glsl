#version 450 core
// One fragment: which rays of the pixel's receiver the triangle blocks. Variants: LKAO_LAYERS, LKAO_MUST_MAY,
// LKAO_CUBE_ADDRESSING, LKAO_DOUBLE, LKAO_ATOMICS (the accumulator: atomics on shader storage, else the logic op),
// LKAO_COUNT.
//
// Based on: S. Laine, T. Karras, "Two Methods for Fast Ray-Cast Ambient Occlusion", EGSR 2010, Sec. 3.1, 4.2.
#define VARYING in
#include "gpu/mesh/varyings.glsl"
#include "gpu/gl/fragment_counters.glsl"
#include "gpu/masks/culls.glsl"
#include "gpu/masks/plane_cells.glsl"
#include "gpu/masks/planes.glsl"
#include "gpu/masks/rays.glsl"
#include "gpu/masks/table.glsl"

#define COUNT_DRAWN COUNT_0
#define COUNT_SURVIVOR COUNT_1
#define COUNT_MASK COUNT_2

// Atomics must not run for fragments that fail the depth test.
layout(early_fragment_tests) in;

#if LKAO_ATOMICS
layout(std430, binding = LKAO_STORAGE_MASKS) buffer Layer { uint words[]; } layers[LKAO_LAYERS];
#else
layout(location = 0) out uvec4 result[LKAO_LAYERS];
#endif

vec3 to_pattern(Frame frame, real3 v) {
#if LKAO_DOUBLE
  return vec3(dot(dvec3(frame.x), v), dot(dvec3(frame.y), v), dot(dvec3(frame.z), v));
#else
  return vec3(dot(frame.x, v), dot(frame.y, v), dot(frame.z, v));
#endif
}

// Figure 1d, and Sec. 4.3: rays that end beyond the triangle's plane, but do not begin to count beyond it.
void keep_within_range(Planes planes, Frame frame, inout Masks masks) {
  const bool takes_any = LKAO_MUST_MAY == 0 && LKAO_DOUBLE == 0;
  uint directions = pass.first_direction;  // cells for rays of one length; 0 where all rays are of one
  real size = sqrt(dot(planes.normal, planes.normal));
  vec3 normal = to_pattern(frame, planes.normal / size);
  if (planes.has_normal || takes_any) {
    float end = directions == 0u ? shape.range.y : ao_radius();
    keep_beyond(plane_cell(normal, float(planes.distance / (size * real(end)))), masks);
    if (directions != 0u && shape.range.y < ao_radius()) {
      keep_beyond(directions + plane_cell(normal, float(planes.distance / (size * real(shape.range.y)))), masks);
    }
  } else {
    doubt(masks);
  }
  if (shape.range.x <= 0.0) return;
  float near = float(planes.distance / (size * real(shape.range.x)));
  if (!planes.has_near && !takes_any) {
    doubt(masks);
  } else if (near <= 1.0) {
    drop_beyond(directions + plane_cell(normal, near), masks);
  }
}

// Figure 1: three edges and the triangle's own plane.
Masks look_up(Planes planes, Frame frame) {
  Masks masks;
  fill(masks);
  for (int i = 0; i < 3; ++i) {
    if (planes.has_edge[i] || (LKAO_MUST_MAY == 0 && LKAO_DOUBLE == 0 && planes.edges[i] != real3(0.0))) {
      real3 edge = planes.edges[i];
      keep_beyond(edge_cell(to_pattern(frame, edge / sqrt(dot(edge, edge)))), masks);
    } else {
      doubt(masks);
    }
  }
  keep_within_range(planes, frame, masks);
  return masks;
}

#if LKAO_MUST_MAY
bool blocks_in_range(Planes planes, vec3 ray, float length) {
  if (shape.range.x == 0.0 && shape.range.y == ao_radius()) return blocks(planes, ray);
  if (shape.range.x >= length) return false;
  precise float begin = shape.range.x / length;
  precise float end = shape.range.y < length ? shape.range.y / length : 1.0;
  return blocks_part(planes, ray, real(begin), real(end));
}

// Adds to `must` those of the rays in doubt that are blocked.
void resolve_doubts(Planes planes, Frame frame, inout Masks masks) {
  for (int k = 0; k < LKAO_LAYERS; ++k) {
    uvec4 doubts = masks.may[k] & ~masks.must[k];
    for (int word = 0; word < 4; ++word) {
      for (uint bits = doubts[word]; bits != 0u; bits &= bits - 1u) {
        int bit = findLSB(bits);
        int i = k * 128 + word * 32 + bit;
        if (blocks_in_range(planes, ray(frame, i), ray_length(i))) masks.must[k][word] |= 1u << bit;
      }
    }
  }
}
#endif

void put(ivec2 pixel, uvec4 masks[LKAO_LAYERS]) {
#if LKAO_ATOMICS
  uint first = (uint(pixel.y) * uint(view.width) + uint(pixel.x)) * 4u;
#define PUT(k)                                                                                    \
  for (int word = 0; word < 4; ++word) {                                                          \
    if (masks[k][word] != 0u) atomicOr(layers[k].words[first + uint(word)], masks[k][word]);      \
  }
  // Blocks are chosen by constants only: other choices need not be supported.
  PUT(0)
#if LKAO_LAYERS > 1
  PUT(1)
#endif
#if LKAO_LAYERS > 2
  PUT(2)
#endif
#if LKAO_LAYERS > 3
  PUT(3)
#endif
#if LKAO_LAYERS > 4
  PUT(4)
#endif
#if LKAO_LAYERS > 5
  PUT(5)
#endif
#if LKAO_LAYERS > 6
  PUT(6)
#endif
#if LKAO_LAYERS > 7
  PUT(7)
#endif
#else
  for (int k = 0; k < LKAO_LAYERS; ++k) result[k] = masks[k];
#endif
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 receiver = texelFetch(receivers, ivec3(pixel, LKAO_RECEIVER_ORIGIN), 0);
  vec3 origin = receiver.xyz;
  if (receiver.w < 0.1 * LKAO_NO_RECEIVER) discard;
  COUNT_DRAWN;
  if (is_culled_by_place(origin, receiver.w)) discard;
  Frame frame = fetch_frame(pixel);
  if (is_culled_by_horizon(origin, frame.up)) discard;
  COUNT_SURVIVOR;
  if (pass.culls_by_reach != 0 && !is_in_reach(origin)) discard;
  Planes planes;
  if (!make_planes(shape.a, shape.b, shape.c, shape.normal, origin, shape.range, planes)) discard;
  COUNT_MASK;
  Masks masks = look_up(planes, frame);
  if (is_empty(masks)) discard;
#if LKAO_MUST_MAY
  resolve_doubts(planes, frame, masks);
#endif
  put(pixel, masks.must);
}
