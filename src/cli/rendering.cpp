#include "cli/rendering.h"

#include <stdexcept>
#include <utility>
#include <vector>

#include "cli/stopwatch.h"
#include "lod/occluders.h"

namespace lkao::cli {
namespace {

// The methods that take part.
struct Casters {
  std::optional<AmbientOcclusion> ao;
  std::optional<reference::EmbreeReference> embree;
  std::optional<RasterFrame> frame;

  Caster caster(Method method) const {
    switch (method) {
      case Method::bvh:
        return {method, answer_of(*ao)};
      case Method::embree:
        return {method, answer_of(*embree, *ao)};
      case Method::raster:
        return {method, frame->answer()};
    }
    throw std::logic_error("unknown method");
  }
};

void load(const RenderingOptions& options, Rendering& result, ProgressBar& progress) {
  progress.begin("loading " + options.scene);
  result.scene = load_scene(options.scene);
  require_radius(options.occlusion.radius, result.scene);
  const float aspect = static_cast<float>(options.size.width) / static_cast<float>(options.size.height);
  result.camera = choose_camera(options.camera, result.scene, aspect);
  progress.clear();
  report_dropped_triangles(result.scene);
}

void make_levels(const RenderingOptions& options, Rendering& result, ProgressBar& progress) {
  if (!options.lod) return;
  const Stopwatch watch;
  result.chain = make_chain(*options.lod, result.scene.mesh, radius_of(options.occlusion), progress);
  result.lod_seconds = watch.seconds();
}

// The hierarchy, and Embree's where it takes part. Embree gets its rays from the query.
void build(const RenderingOptions& options, Casters& casters, Rendering& result, ProgressBar& progress) {
  if (options.method == Method::raster && !options.reference) return;
  const scene::Mesh& mesh = result.scene.mesh;
  progress.begin("building the hierarchy");
  Stopwatch watch;
  std::vector<OccluderLevel> levels = result.chain ? lod::build_levels(*result.chain, radius_of(options.occlusion))
                                                   : std::vector{OccluderLevel{OccluderBvh(mesh.view())}};
  result.build_seconds = watch.lap();
  casters.ao.emplace(make_query(std::move(levels), options.occlusion));
  watch.lap();
  if (options.method == Method::bvh && !options.reference) return;
  casters.embree.emplace(mesh);
  result.embree_build_seconds = watch.lap();
}

Batch ask(const RenderingOptions& options, const Casters& casters, const scene::ReceiverImage& view,
          ProgressBar& progress) {
  BatchOptions batch_options{.check = {}, .bent_normals = options.layers.bent_normals};
  if (options.reference) batch_options.check = casters.caster(other_than(options.method));
  Batch batch = run_batch(casters.caster(options.method), make_pattern(options.occlusion), view.receivers,
                          batch_options, progress);
  batch.invalid_receiver_count -= view.receivers.size() - view.receiver_count;
  if (casters.frame) batch.seconds = casters.frame->report.draw_seconds;
  return batch;
}

}  // namespace

Rendering compute_rendering(const RenderingOptions& options, ProgressBar& progress) {
  Rendering result;
  std::optional<RasterMethod> raster;
  // First: where there is no such device, nothing else is worth doing.
  if (options.method == Method::raster) raster.emplace(options.raster, options.size);
  load(options, result, progress);
  make_levels(options, result, progress);
  Casters casters;
  build(options, casters, result, progress);

  progress.begin("finding receivers");
  const Stopwatch watch;
  result.view = scene::find_receivers(result.scene.mesh, result.camera, options.size.width, options.size.height);
  result.camera_seconds = watch.seconds();

  if (raster) {
    progress.begin("drawing");
    const lod::RangedMesh merged =
        result.chain ? lod::merge(*result.chain, radius_of(options.occlusion)) : lod::RangedMesh{};
    casters.frame =
        raster->draw(result.chain ? merged.mesh : result.scene.mesh, merged.ranges, result.camera, result.view,
                     options.occlusion, {.bent_normals = options.layers.bent_normals, .masks = options.reference});
    result.raster = casters.frame->report;
  }
  result.batch = ask(options, casters, result.view, progress);
  progress.clear();
  return result;
}

}  // namespace lkao::cli
