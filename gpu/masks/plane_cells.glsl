// From planes to cells of the plane mask table: lut/plane_cells.h once more, operation by operation, so that a plane
// has the same cell here and there. `normal` is of unit length, `distance` in units of the AO radius. Either
// LKAO_CUBE_ADDRESSING is 1, or the cells are maps for slices of distance.
#include "gpu/masks/mask_pass_block.h"

#if LKAO_CUBE_ADDRESSING

uint grid_place(float coordinate, float resolution) {
  precise float place = (coordinate * 0.5 + 0.5) * (resolution - 1.0);
  precise float rounded = place + 0.5;
  return uint(clamp(rounded, 0.0, resolution - 0.5));
}

uint plane_cell(vec3 normal, float distance) {
  float largest = max(abs(normal.x), max(abs(normal.y), abs(normal.z)));
  precise float scale = (1.0 - 0.875 * clamp(distance, 0.0, 1.0)) / largest;
  precise vec3 place = normal * scale;
  uint side = pass.cube_side;
  float resolution = float(side);
  return (grid_place(place.z, resolution) * side + grid_place(place.y, resolution)) * side +
         grid_place(place.x, resolution);
}

uint edge_cell(vec3 normal) { return plane_cell(normal, 0.0); }

#else

float warp(float x) {
  precise float w = 1.4 * x / (1.0 + 0.4 * abs(x));
  return w;
}

uint cube_map_cell(vec3 normal, uint side) {
  vec3 size = abs(normal);
  float along = normal.x, u = normal.y, v = normal.z;
  uint face = 0u;
  if (size.y > size.x && size.y >= size.z) {
    along = normal.y, u = normal.z, v = normal.x, face = 2u;
  } else if (size.z > size.x) {
    along = normal.z, u = normal.x, v = normal.y, face = 4u;
  }
  if (along < 0.0) ++face;
  precise float scale = 1.0 / abs(along);
  precise vec2 place = (vec2(warp(u * scale), warp(v * scale)) + 1.0) * (0.5 * float(side));
  uvec2 cell = min(uvec2(max(place, vec2(0.0))), uvec2(side - 1u));
  return (face * side + cell.y) * side + cell.x;
}

uint plane_cell(vec3 normal, float distance) {
  precise float root = sqrt(1.0 - clamp(distance, 0.0, 1.0));
  precise float place = (1.0 - 0.5 * (root + root * root)) * float(pass.slice_count);
  uint slice = min(uint(max(place, 0.0)), pass.slice_count - 1u);
  return pass.first_slice + slice * pass.slice_size + cube_map_cell(normal, pass.slice_side);
}

uint edge_cell(vec3 normal) { return cube_map_cell(normal, pass.edge_side); }

#endif
