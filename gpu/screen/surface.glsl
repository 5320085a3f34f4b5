// What a pixel shows, in view space: positions and unit normals.
#include "gpu/frame/g_buffer.glsl"

struct Surface {
  vec3 position, normal, geometric_normal;
};

// Normals may be of any length: first of one whose square is a float. Zero where there is none.
vec3 unit_normal(vec3 normal) {
  float largest = max(abs(normal.x), max(abs(normal.y), abs(normal.z)));
  return largest == 0.0 ? vec3(0) : normalize(normal / largest);
}

// False where there is no receiver.
bool find_surface(ivec2 pixel, out Surface surface) {
  if (!find_position(pixel, surface.position) || !is_position_in_range(surface.position)) return false;
  surface.normal = unit_normal(read_normal(pixel));
  surface.geometric_normal = unit_normal(read_geometric_normal(pixel));
  return surface.normal != vec3(0);
}
