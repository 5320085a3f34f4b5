#include "cli/rendering.h"

#include <limits>
#include <memory>

#include <fmt/format.h>

#include "cli/normals_option.h"
#include "method/occluders.h"
#include "method/stopwatch.h"

namespace lkao::cli {
namespace {

using method::Stopwatch;

// The method in question, and perhaps the one that it is checked against.
struct Methods {
  std::unique_ptr<method::Method> asked;
  std::unique_ptr<method::Method> check;
};

Methods open(const RenderingOptions& options) {
  const auto& [kind, settings] = options.method;
  Methods methods{open_method(options.method, options.parts), nullptr};
  methods.asked->require_size(options.size.width, options.size.height);
  if (options.reference) methods.check = method::reference_of(*kind).open(settings);
  return methods;
}

void load(const RenderingOptions& options, Rendering& result, ProgressBar& progress) {
  progress.begin("loading " + options.scene.name);
  SceneOptions scene = options.scene;
  const bool has_holes = options.method.kind->abilities(options.method.settings).holes && !options.lod;
  scene.opaque = scene.opaque || !has_holes;  // which is said of a scene that has some
  result.scene = load_scene(scene);
  result.radius =
      options.light ? std::numeric_limits<double>::infinity() : resolve_radius(options.occlusion.radius, result.scene);
  result.normals = choose_normals(options.normals, result.scene);
  const float aspect = static_cast<float>(options.size.width) / static_cast<float>(options.size.height);
  result.camera = choose_camera(options.camera, result.scene, aspect);
  add_surroundings(result.scene, options.scene, result.camera.up, result.radius);
  progress.clear();
  print_notes(result.scene.notes);
}

void make_levels(const RenderingOptions& options, float radius, Rendering& result, ProgressBar& progress) {
  if (!options.lod) return;
  const Stopwatch watch;
  result.chain = make_chain(*options.lod, result.scene, radius, progress);
  result.lod_seconds = watch.seconds();
}

void find_receivers(const RenderingOptions& options, Rendering& result, ProgressBar& progress) {
  progress.begin("finding receivers");
  const Stopwatch watch;
  result.view = scene::find_receivers(result.scene.seen(), result.camera, options.size.width, options.size.height,
                                      result.normals);
  result.camera_seconds = watch.seconds();
}

void prepare(const Methods& methods, const RenderingOptions& options, const method::Question& question,
             Rendering& result, ProgressBar& progress) {
  const scene::Mesh& mesh = result.scene.occluders();
  method::Occluders occluders =
      result.chain ? method::Occluders(mesh, *result.chain, question.radius) : method::Occluders(mesh);
  const auto prepare_one = [&](method::Method* method, const method::MethodKind& kind) {
    if (method == nullptr) return;
    progress.begin(fmt::format("preparing {}", kind.word));
    method->prepare({occluders, question, method::View{result.camera, result.view}});
    if (method->build_seconds() > 0) result.own_build_seconds.emplace_back(kind.word, method->build_seconds());
  };
  prepare_one(methods.asked.get(), *options.method.kind);
  prepare_one(methods.check.get(), method::reference_of(*options.method.kind));
  result.build_seconds = occluders.build_seconds();
}

void ask(const Methods& methods, const RenderingOptions& options, const method::Question& question, Rendering& result,
         ProgressBar& progress) {
  const std::vector<Receiver>& receivers = result.view.receivers;
  const bool draws = !methods.asked->abilities().any_receivers;
  result.batch = method::run_batch(*methods.asked, question.ray_count, receivers,
                                   {.check = methods.check.get(),
                                    .bent_normals = options.layers.bent_normals,
                                    .progress = progress.watch(draws ? "drawing" : "casting rays")});
  result.batch.invalid_receiver_count -= receivers.size() - result.view.receiver_count;
  result.remarks = methods.asked->remarks();
}

}  // namespace

Rendering compute_rendering(const RenderingOptions& options, ProgressBar& progress) {
  Rendering result;
  const Methods methods = open(options);  // first: where there is no such device, nothing else is worth doing
  load(options, result, progress);
  method::Question question = options.occlusion.question(result.radius);
  if (options.light) question.light = area_light(*options.light, result.scene.mesh.origin);
  make_levels(options, question.radius, result, progress);
  find_receivers(options, result, progress);
  prepare(methods, options, question, result, progress);
  ask(methods, options, question, result, progress);
  progress.clear();
  return result;
}

}  // namespace lkao::cli
