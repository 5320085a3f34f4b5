// What all shaders of shapes know.
#include "gpu/frame/view.glsl"
#include "gpu/mesh/draw_words.h"
#include "gpu/mesh/shapes_block.h"
#include "gpu/mesh/units.h"

float ao_radius() { return shapes.radius; }
// Of what an automatic surface offset adds: beyond it there would be no contact left to be seen.
float largest_added_offset() { return shapes.is_unbounded != 0 ? 1e18 : 0.25 * ao_radius(); }
bool is_two_sided() { return shapes.is_two_sided != 0; }
