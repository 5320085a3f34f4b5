// Looking planes up in the plane mask table: bvh/table_lookup.h of the CPU. LKAO_LAYERS is the number of 128-bit parts
// of a mask. Of each cell there is either the mask of the plane in its middle, or (LKAO_MUST_MAY) first the rays beyond
// all of its planes, then those beyond some.
#include "gpu/masks/mask_pass_block.h"
#include "gpu/masks/units.h"

layout(binding = LKAO_UNIT_TABLE) uniform usamplerBuffer table;

struct Masks {
  uvec4 must[LKAO_LAYERS];
#if LKAO_MUST_MAY
  uvec4 may[LKAO_LAYERS];
#endif
};

// Bits of the 32 rays from `first` on, as many of them as there are.
uint bits_from(int first) {
  int count = pass.ray_count - first;
  return count >= 32 ? 0xffffffffu : (1u << max(count, 0)) - 1u;
}

// All rays.
void fill(inout Masks masks) {
  const int last = LKAO_LAYERS - 1, first = 128 * last;
  for (int k = 0; k < last; ++k) masks.must[k] = uvec4(0xffffffffu);
  masks.must[last] = uvec4(bits_from(first), bits_from(first + 32), bits_from(first + 64), bits_from(first + 96));
#if LKAO_MUST_MAY
  masks.may = masks.must;
#endif
}

// Takes away the rays that are not beyond a plane of the cell.
void keep_beyond(uint cell, inout Masks masks) {
#if LKAO_MUST_MAY
  int first = int(cell) * (2 * LKAO_LAYERS);
  for (int k = 0; k < LKAO_LAYERS; ++k) masks.may[k] &= texelFetch(table, first + LKAO_LAYERS + k);
#else
  int first = int(cell) * LKAO_LAYERS;
#endif
  for (int k = 0; k < LKAO_LAYERS; ++k) masks.must[k] &= texelFetch(table, first + k);
}

// Takes away the rays that are beyond a plane of the cell.
void drop_beyond(uint cell, inout Masks masks) {
#if LKAO_MUST_MAY
  int first = int(cell) * (2 * LKAO_LAYERS);
  for (int k = 0; k < LKAO_LAYERS; ++k) {
    masks.may[k] &= ~texelFetch(table, first + k);
    masks.must[k] &= ~texelFetch(table, first + LKAO_LAYERS + k);
  }
#else
  int first = int(cell) * LKAO_LAYERS;
  for (int k = 0; k < LKAO_LAYERS; ++k) masks.must[k] &= ~texelFetch(table, first + k);
#endif
}

// A plane whose cell is not known: all rays may be beyond it, none must.
void doubt(inout Masks masks) {
#if LKAO_MUST_MAY
  for (int k = 0; k < LKAO_LAYERS; ++k) masks.must[k] = uvec4(0u);
#endif
}

bool is_empty(Masks masks) {
  uvec4 any_bits = uvec4(0u);
#if LKAO_MUST_MAY
  for (int k = 0; k < LKAO_LAYERS; ++k) any_bits |= masks.may[k];
#else
  for (int k = 0; k < LKAO_LAYERS; ++k) any_bits |= masks.must[k];
#endif
  return (any_bits.x | any_bits.y | any_bits.z | any_bits.w) == 0u;
}
