#include "lkao/c/bvh.h"

#include <cstring>
#include <optional>
#include <string>

#include "c_api/convert.h"
#include "c_api/handles.h"
#include "c_api/versioned.h"

using namespace lkao::c_api;

namespace {

lkao::PositionView positions_of(const lkao_mesh& mesh) {
  if (mesh.position_count > 0) needed(mesh.positions, "mesh->positions");
  const double* const origin = mesh.origin;
  switch (mesh.position_type) {
    case LKAO_FLOAT:
      if (origin[0] != 0 || origin[1] != 0 || origin[2] != 0) {
        refuse("mesh->origin must be 0 unless mesh->position_type is LKAO_DOUBLE");
      }
      return {static_cast<const float*>(mesh.positions), mesh.position_count, mesh.position_stride};
    case LKAO_DOUBLE:
      return {static_cast<const double*>(mesh.positions), mesh.position_count,
              glm::dvec3(origin[0], origin[1], origin[2]), mesh.position_stride};
    default:
      refuse("mesh->position_type must be LKAO_FLOAT or LKAO_DOUBLE, not " + std::to_string(mesh.position_type));
  }
}

lkao::IndexView triangles_of(const lkao_mesh& mesh) {
  if (mesh.triangle_count > 0) needed(mesh.indices, "mesh->indices");
  switch (mesh.index_type) {
    case LKAO_UINT16:
      return {static_cast<const std::uint16_t*>(mesh.indices), mesh.triangle_count, mesh.triangle_stride};
    case LKAO_UINT32:
      return {static_cast<const std::uint32_t*>(mesh.indices), mesh.triangle_count, mesh.triangle_stride};
    case LKAO_INT32:
      return {static_cast<const std::int32_t*>(mesh.indices), mesh.triangle_count, mesh.triangle_stride};
    default:
      refuse("mesh->index_type must be LKAO_UINT16, LKAO_UINT32 or LKAO_INT32, not " + std::to_string(mesh.index_type));
  }
}

void write_origin(const glm::dvec3& from, double origin[3]) {
  for (int axis = 0; axis < 3; ++axis) origin[axis] = from[axis];
}

}  // namespace

lkao_status lkao_bvh_create(const lkao_mesh* mesh, const lkao_build_options* options, lkao_bvh** bvh) {
  return create(__func__, bvh, "bvh", [&] {
    const lkao_mesh from = read(mesh, LKAO_MESH_INIT, "mesh");
    const lkao_build_options how = read_or_defaults(options, LKAO_BUILD_OPTIONS_INIT, "options");
    const lkao::TriangleMesh view{positions_of(from), triangles_of(from)};
    std::optional<lkao::OccluderBvh> built;
    run_on_threads(how.thread_count, "options->thread_count", [&] {
      built.emplace(view, lkao::BuildOptions{.spatial_splits = how.spatial_splits != 0},
                    progress_of(how.progress, how.progress_user));
    });
    return *built;
  });
}

lkao_status lkao_bvh_destroy(lkao_bvh* bvh) { return destroy(__func__, bvh, "bvh"); }

lkao_status lkao_bvh_get_report(const lkao_bvh* bvh, lkao_build_report* report) {
  return guard(__func__, [&] {
    check_size(report, "report");
    const lkao::BuildReport& from = object(bvh, "bvh").report();
    lkao_build_report result = LKAO_BUILD_REPORT_INIT;
    result.triangle_count = from.triangle_count;
    result.occluder_count = from.occluder_count;
    result.zero_area_count = from.zero_area_count;
    result.non_finite_count = from.non_finite_count;
    result.reference_count = from.reference_count;
    result.node_count = from.node_count;
    result.memory_bytes = from.memory_bytes;
    result.seconds = from.seconds;
    write(result, report);
  });
}

lkao_status lkao_bvh_get_bounds(const lkao_bvh* bvh, lkao_bounds* bounds) {
  return guard(__func__, [&] {
    needed(bounds, "bounds");
    static_assert(sizeof(lkao_bounds) == sizeof(lkao::Bounds));
    std::memcpy(bounds, &object(bvh, "bvh").bounds(), sizeof(lkao_bounds));
  });
}

lkao_status lkao_bvh_get_origin(const lkao_bvh* bvh, double origin[3]) {
  return guard(__func__, [&] {
    needed(origin, "origin");
    write_origin(object(bvh, "bvh").origin(), origin);
  });
}

lkao_status lkao_choose_origin(const lkao_mesh* mesh, double origin[3]) {
  return guard(__func__, [&] {
    needed(origin, "origin");
    write_origin(lkao::choose_origin(positions_of(read(mesh, LKAO_MESH_INIT, "mesh"))), origin);
  });
}
