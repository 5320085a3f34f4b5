// Passing a triangle on to the fragments of its volume.
#define VARYING out
#include "gpu/volumes/varyings.glsl"

void pass_on(Occluder o, Volume v) {
  shape.a = o.a;
  shape.b = o.b;
  shape.c = o.c;
  shape.base_a = v.base[0];
  shape.base_b = v.base[1];
  shape.base_c = v.base[2];
  shape.normal = o.normal;
  shape.opacity = o.opacity;
}
