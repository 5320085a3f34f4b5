#include "gpu/mesh/shapes.h"

namespace lkao::gl {

ShapePrograms make_shape_programs(GeometryBackEnd back_end, const std::string& fragment, const Defines& defines) {
  if (back_end == GeometryBackEnd::geometry_shader) {
    return {make_program({"mesh/point.vert", "mesh/prism.geom", fragment}, defines),
            make_program({"mesh/point.vert", "mesh/billboard.geom", fragment}, defines)};
  }
  return {make_program({"mesh/prism.vert", fragment}, defines),
          make_program({"mesh/billboard.vert", fragment}, defines)};
}

void set_camera(const Camera& camera, const Pixels& pixels, const ViewBlock& view, float radius, ShapesBlock& block) {
  glm::dvec4 depth_row;
  if (view.is_perspective != 0) {
    // 1 / 1024 of the radius: nothing nearer matters, and float keeps its precision whatever the scale.
    block.depth_scale = radius * 0x1p-10f;
    block.depth_far = 0;
    depth_row = glm::dvec4(0, 0, 0, block.depth_scale);
  } else {
    const DepthEnds ends = orthographic_depth_ends(camera);
    block.depth_scale = static_cast<float>(1.0 / (ends.farthest - ends.nearest));
    block.depth_far = static_cast<float>(ends.farthest);
    const double scale = block.depth_scale;
    // Distance along the view is minus the third row of `view`.
    for (int column = 0; column < 4; ++column) depth_row[column] = scale * static_cast<double>(camera.view[column][2]);
    depth_row.w += scale * static_cast<double>(block.depth_far);
  }
  glm::dmat4 clip = clip_from_world(camera, pixels);
  for (int column = 0; column < 4; ++column) clip[column][2] = depth_row[column];
  block.clip_from_world = glm::mat4(clip);
  block.radius = radius;
  block.reach = 1;
}

}  // namespace lkao::gl
