// Passing a triangle on to its fragments.
#define VARYING out
#include "gpu/mesh/varyings.glsl"

void pass_on(Occluder o) {
  shape.a = o.a;
  shape.b = o.b;
  shape.c = o.c;
  shape.normal = o.normal;
  shape.sphere = o.sphere;
  shape.nearest_depth = o.depths.x;
  shape.range = o.range;
}
