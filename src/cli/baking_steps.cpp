#include "cli/baking_steps.h"

#include <utility>

#include "cli/normals_option.h"
#include "method/occluders.h"

namespace lkao::cli {

void load_for_baking(const BakingOptions& options, Baking& result, ProgressBar& progress) {
  progress.begin("loading " + options.scene.name);
  result.scene = load_scene(options.scene);
  result.radius = resolve_radius(options.occlusion.radius, result.scene);
  result.normals = choose_normals(options.normals, result.scene);
  add_surroundings(result.scene, options.scene, options.up, result.radius);
  progress.clear();
  print_notes(result.scene.notes);
}

Asker::Asker(const BakingOptions& options, Baking& result, ProgressBar& progress)
    : ray_count_(options.occlusion.ray_count),
      result_(result),
      progress_(progress),
      method_(open_method(options.method, options.parts, options.scene.own_object)) {
  progress.begin("building the hierarchy");
  method::Occluders occluders(result.scene.occluders());
  method_->prepare({occluders, options.occlusion.question(result.radius)});
  result.build_seconds = occluders.build_seconds() + method_->build_seconds();
}

std::vector<float> Asker::operator()(std::span<const Receiver> receivers) const {
  method::Batch& batch = result_.batch;
  batch = method::run_batch(*method_, ray_count_, receivers, {.progress = progress_.watch("casting rays")});
  result_.receiver_count = receivers.size() - batch.invalid_receiver_count;
  result_.remarks = method_->remarks();
  return std::move(batch.occlusion);
}

void Asker::answer(std::span<const Receiver> receivers, const QueryOutputs& outputs, std::uint64_t first_index) const {
  const method::Answered answered = method_->answer(receivers, outputs, first_index);
  method::Batch& batch = result_.batch;
  batch.seconds += answered.seconds;
  batch.ray_count += answered.report.ray_count;
  batch.invalid_receiver_count += answered.report.invalid_receiver_count;
  result_.receiver_count += receivers.size() - answered.report.invalid_receiver_count;
  result_.remarks = method_->remarks();
}

}  // namespace lkao::cli
