// What all shaders of shapes know.
#include "gpu/frame/view.glsl"
#include "gpu/mesh/draw_words.h"
#include "gpu/mesh/shapes_block.h"
#include "gpu/mesh/units.h"

float ao_radius() { return shapes.radius; }
bool is_two_sided() { return shapes.is_two_sided != 0; }
