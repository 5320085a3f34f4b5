// Meshes of callers, and hierarchies over them.
#pragma once

#include <string>

#include <glm/vec3.hpp>

#include "lkao/c.h"
#include "lkao/lkao.h"

namespace lkao::c_api {

// Views of the caller's arrays; `name` is the mesh's, for errors.
PositionView positions_of(const lkao_mesh& mesh, const std::string& name);
IndexView triangles_of(const lkao_mesh& mesh, const std::string& name);

BuildOptions build_options_of(const lkao_build_options& options);
OccluderBvh build(const lkao_mesh* mesh, const lkao_build_options* options);

lkao_bounds c_bounds_of(const Bounds& bounds);
void write_origin(const glm::dvec3& from, double origin[3]);

}  // namespace lkao::c_api
