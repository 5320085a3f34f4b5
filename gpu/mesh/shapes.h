// The shapes that bound what triangles can darken: their programs and the camera as they see it.
#pragma once

#include <string>

#include "gpu/frame/view.h"
#include "gpu/frame/view_block.h"
#include "gpu/gl/program.h"
#include "gpu/mesh/shapes_block.h"
#include "lkao/gl/frame.h"
#include "lkao/gl/occluders.h"

namespace lkao::gl {

enum class Shape { prism, billboard };

struct ShapePrograms {
  ProgramObject prism, billboard;
};

// With the fragment shader of that name.
ShapePrograms make_shape_programs(GeometryBackEnd back_end, const std::string& fragment, const Defines& defines);

// What of the block depends on the camera and the radius: where shapes are on the screen, and their depth (depth.glsl).
// `view` is of the same camera and pixels.
void set_camera(const Camera& camera, const Pixels& pixels, const ViewBlock& view, float radius, ShapesBlock& block);

}  // namespace lkao::gl
