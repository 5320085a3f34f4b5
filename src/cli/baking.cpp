#include "cli/baking.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "bake/corner_receivers.h"
#include "bake/face_samples.h"
#include "bake/least_squares.h"
#include "bake/split_vertices.h"
#include "cli/normals_option.h"
#include "method/occluders.h"

namespace lkao::cli {
namespace {

void load(const BakingOptions& options, Baking& result, ProgressBar& progress) {
  progress.begin("loading " + options.scene.name);
  result.scene = load_scene(options.scene);
  result.radius = resolve_radius(options.occlusion.radius, result.scene);
  result.normals = choose_normals(options.normals, result.scene);
  add_surroundings(result.scene, options.scene, options.up, result.radius);
  progress.clear();
  print_notes(result.scene.notes);
}

// A method that is ready to answer about a scene.
class Asker {
 public:
  Asker(const BakingOptions& options, Baking& result, ProgressBar& progress)
      : ray_count_(options.occlusion.ray_count),
        result_(result),
        progress_(progress),
        method_(options.method.kind->open(options.method.settings)) {
    progress.begin("building the hierarchy");
    method::Occluders occluders(result.scene.occluders());
    method_->prepare({occluders, options.occlusion.question(result.radius)});
    result.build_seconds = occluders.build_seconds();
  }

  // Receiver k has index k.
  std::vector<float> operator()(const std::vector<Receiver>& receivers) const {
    method::Batch& batch = result_.batch;
    batch = method::run_batch(*method_, ray_count_, receivers,
                              {.progress = progress_.watch("casting rays", receivers.size())});
    result_.receiver_count = receivers.size() - batch.invalid_receiver_count;
    result_.remarks = method_->remarks();
    return std::move(batch.occlusion);
  }

 private:
  int ray_count_;
  Baking& result_;
  ProgressBar& progress_;
  std::unique_ptr<method::Method> method_;
};

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
  load(options, result, progress);
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
