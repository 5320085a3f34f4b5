// Passing a triangle on to the fragments of its volume.
#define VARYING out
#include "gpu/volumes/varyings.glsl"

void pass_on(Occluder o) {
  shape.a = o.a;
  shape.b = o.b;
  shape.c = o.c;
  shape.normal = o.normal;
  shape.opacity = o.opacity;
}
