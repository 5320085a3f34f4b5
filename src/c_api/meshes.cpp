#include "c_api/meshes.h"

#include <cstring>
#include <optional>

#include "c_api/convert.h"
#include "c_api/errors.h"
#include "c_api/versioned.h"
#include "c_api/words.h"

namespace lkao::c_api {

PositionView positions_of(const lkao_mesh& mesh, const std::string& name) {
  if (mesh.position_count > 0) needed(mesh.positions, (name + "->positions").c_str());
  const double* const origin = mesh.origin;
  switch (mesh.position_type) {
    case LKAO_FLOAT:
      if (origin[0] != 0 || origin[1] != 0 || origin[2] != 0) {
        refuse(name + "->origin must be 0 unless its position_type is LKAO_DOUBLE");
      }
      return {static_cast<const float*>(mesh.positions), mesh.position_count, mesh.position_stride};
    case LKAO_DOUBLE:
      return {static_cast<const double*>(mesh.positions), mesh.position_count,
              glm::dvec3(origin[0], origin[1], origin[2]), mesh.position_stride};
    default:
      refuse(name + "->position_type must be LKAO_FLOAT or LKAO_DOUBLE, not " + std::to_string(mesh.position_type));
  }
}

IndexView triangles_of(const lkao_mesh& mesh, const std::string& name) {
  if (mesh.triangle_count > 0) needed(mesh.indices, (name + "->indices").c_str());
  switch (mesh.index_type) {
    case LKAO_UINT16:
      return {static_cast<const std::uint16_t*>(mesh.indices), mesh.triangle_count, mesh.triangle_stride};
    case LKAO_UINT32:
      return {static_cast<const std::uint32_t*>(mesh.indices), mesh.triangle_count, mesh.triangle_stride};
    case LKAO_INT32:
      return {static_cast<const std::int32_t*>(mesh.indices), mesh.triangle_count, mesh.triangle_stride};
    default:
      refuse(name + "->index_type must be LKAO_UINT16, LKAO_UINT32 or LKAO_INT32, not " +
             std::to_string(mesh.index_type));
  }
}

namespace {

CutOuts cut_outs_of(const lkao_build_options& options) {
  CutOuts result;
  if (options.opacity_count > 0) {
    const float* const first = needed(options.opacities, "options->opacities");
    result.opacities.assign(first, first + options.opacity_count);
  }
  if (options.cut_out_filter != nullptr) {
    result.blocks = [filter = options.cut_out_filter, user = options.cut_out_user](
                        std::uint32_t instance, std::uint32_t primitive, float u, float v) {
      return filter(user, instance, primitive, u, v) != 0;
    };
  }
  if (options.cut_out_survey != nullptr) {
    if (options.cut_out_filter == nullptr) {
      refuse("options->cut_out_survey must be NULL without options->cut_out_filter, which it speaks of");
    }
    result.survey = [survey = options.cut_out_survey, user = options.cut_out_user](std::uint32_t primitive, float u0,
                                                                                   float v0, float size) {
      return word(kCutOutParts, survey(user, primitive, u0, v0, size), "what options->cut_out_survey returns");
    };
  }
  if (options.cut_out_look_count > 0) {
    const std::uint32_t* const first = needed(options.cut_out_looks, "options->cut_out_looks");
    result.looks.assign(first, first + options.cut_out_look_count);
  }
  return result;
}

}  // namespace

BuildOptions build_options_of(const lkao_build_options& options) {
  return {.spatial_splits = options.spatial_splits != 0,
          .keep_zero_area = options.keep_zero_area != 0,
          .mesh_storage = word(kMeshStorages, options.mesh_storage, "options->mesh_storage"),
          .cut_outs = cut_outs_of(options)};
}

OccluderBvh build(const lkao_mesh* mesh, const lkao_build_options* options) {
  const lkao_mesh from = read(mesh, LKAO_MESH_INIT, "mesh");
  const lkao_build_options how = read_or_defaults(options, LKAO_BUILD_OPTIONS_INIT, "options");
  const TriangleMesh view{positions_of(from, "mesh"), triangles_of(from, "mesh")};
  std::optional<OccluderBvh> built;
  run_on_threads(how.thread_count, "options->thread_count",
                 [&] { built.emplace(view, build_options_of(how), progress_of(how.progress, how.progress_user)); });
  return *std::move(built);
}

lkao_bounds c_bounds_of(const Bounds& bounds) {
  lkao_bounds result;
  static_assert(sizeof(result) == sizeof(bounds));
  std::memcpy(&result, &bounds, sizeof(result));
  return result;
}

void write_origin(const glm::dvec3& from, double origin[3]) {
  for (int axis = 0; axis < 3; ++axis) origin[axis] = from[axis];
}

}  // namespace lkao::c_api
