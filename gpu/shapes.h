// Programs that draw the shapes around triangles.
#pragma once

#include <string>

#include "gpu/program.h"
#include "lkao/gl.h"

namespace lkao::gl {

struct ShapePrograms {
  ProgramObject prism, billboard;
};

// With the fragment shader of that name.
inline ShapePrograms make_shape_programs(GeometryBackEnd back_end, const std::string& fragment,
                                         const Defines& defines) {
  if (back_end == GeometryBackEnd::geometry_shader) {
    return {make_program({"point.vert", "prism.geom", fragment}, defines),
            make_program({"point.vert", "billboard.geom", fragment}, defines)};
  }
  return {make_program({"prism.vert", fragment}, defines), make_program({"billboard.vert", fragment}, defines)};
}

}  // namespace lkao::gl
