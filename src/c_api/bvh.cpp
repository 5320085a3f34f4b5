#include "lkao/c/bvh.h"

#include <optional>
#include <utility>

#include "c_api/convert.h"
#include "c_api/handles.h"
#include "c_api/meshes.h"
#include "c_api/versioned.h"

using namespace lkao::c_api;

lkao_status lkao_bvh_create(const lkao_mesh* mesh, const lkao_build_options* options, lkao_bvh** bvh) {
  return create(__func__, bvh, "bvh", [&] { return build(mesh, options); });
}

lkao_status lkao_bvh_create_refitted(const lkao_bvh* bvh, const lkao_mesh* mesh, const lkao_refit_options* options,
                                     lkao_bvh** refitted) {
  return create(__func__, refitted, "refitted", [&] {
    const lkao::OccluderBvh& found = object(bvh, "bvh");
    const lkao::PositionView positions = positions_of(read(mesh, LKAO_MESH_INIT, "mesh"), "mesh");
    const lkao_refit_options how = read_or_defaults(options, LKAO_REFIT_OPTIONS_INIT, "options");
    std::optional<lkao::OccluderBvh> result;
    run_on_threads(how.thread_count, "options->thread_count", [&] {
      result = found.refitted(positions, {.max_growth = how.max_growth}, progress_of(how.progress, how.progress_user));
    });
    return *std::move(result);
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
    result.surface_area_cost = from.surface_area_cost;
    result.growth = from.growth;
    write(result, report);
  });
}

lkao_status lkao_bvh_get_bounds(const lkao_bvh* bvh, lkao_bounds* bounds) {
  return guard(__func__, [&] { *needed(bounds, "bounds") = c_bounds_of(object(bvh, "bvh").bounds()); });
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
    write_origin(lkao::choose_origin(positions_of(read(mesh, LKAO_MESH_INIT, "mesh"), "mesh")), origin);
  });
}
