#include "cli/baking.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bake/corner_receivers.h"
#include "bake/face_samples.h"
#include "bake/least_squares.h"
#include "bake/split_vertices.h"
#include "cli/baking_steps.h"

namespace lkao::cli {
namespace {

// One a place.
std::vector<float> values_of_places(const BakingOptions& options, const SceneInput& scene,
                                    const scene::CornerNormals& normals, const bake::Places& places, const Asker& ask) {
  const scene::Mesh& mesh = normals.mesh();
  if (options.filter == Filter::least_squares) {
    const bake::FaceSamples samples = bake::sample_faces(normals);
    return bake::least_squares_values(mesh, places, samples, ask(samples.receivers));
  }
  const Bounds occluders = scene::bounds_of(scene.occluders());
  return bake::average_at_places(mesh, places, ask(bake::corner_receivers(normals, occluders)), occluders);
}

}  // namespace

Baking compute_baking(const BakingOptions& options, ProgressBar& progress) {
  Baking result;
  load_for_baking(options, result, progress);
  const Asker ask(options, result, progress);
  std::vector<float> occlusion;
  {
    const scene::CornerNormals normals(result.scene.mesh, result.normals);
    if (options.per == bake::Per::face) {
      const bake::FaceSamples samples = bake::sample_faces(normals);
      occlusion = bake::average_on_faces(samples, ask(samples.receivers));
    } else {
      const bake::Places places = bake::make_places(normals, options.per);
      const std::vector<float> values = values_of_places(options, result.scene, normals, places, ask);
      occlusion = bake::split_vertices(result.scene.mesh, places, values);
    }
  }
  const auto is_bare = [](float value) { return std::isnan(value); };
  result.bare_count = static_cast<std::size_t>(std::count_if(occlusion.begin(), occlusion.end(), is_bare));
  result.batch.occlusion = std::move(occlusion);
  progress.clear();
  return result;
}

}  // namespace lkao::cli
