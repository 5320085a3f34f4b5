// lkao bake: occlusion per vertex of a mesh.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "cli/commands.h"
#include "cli/json_output.h"
#include "cli/method_options.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/parse.h"
#include "cli/parsed_option.h"
#include "cli/progress_bar.h"
#include "cli/report.h"
#include "cli/scene_input.h"
#include "method/batch.h"
#include "method/setting_options.h"
#include "scene/ply_writer.h"

namespace lkao::cli {
namespace {

struct BakeOptions {
  SceneOptions scene;
  glm::vec3 up{0, 1, 0};
  std::string output;
  OcclusionOptions occlusion;
  MethodOptions method;  // the traversal
  CommonOptions common;
};

struct Bake {
  SceneInput scene;
  double radius = 0;  // in the scene's unit
  double build_seconds = 0;
  method::Batch batch;  // receiver k is vertex k
  method::Remarks remarks;
};

std::vector<Receiver> vertex_receivers(const scene::Mesh& mesh) {
  const std::vector<glm::vec3> normals = scene::vertex_normals(mesh);
  std::vector<Receiver> receivers(mesh.positions.size());
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    receivers[i].position = mesh.positions[i];
    receivers[i].normal = normals[i];
  }
  return receivers;
}

Bake compute(const BakeOptions& options, ProgressBar& progress) {
  Bake result;
  progress.begin("loading " + options.scene.name);
  result.scene = load_scene(options.scene);
  const scene::Mesh& mesh = result.scene.mesh;
  result.radius = resolve_radius(options.occlusion.radius, result.scene);
  add_surroundings(result.scene, options.scene, options.up, result.radius);
  progress.clear();
  print_notes(result.scene.notes);

  progress.begin("building the hierarchy");
  method::Occluders occluders(result.scene.occluders());
  const method::Question question = options.occlusion.question(result.radius);
  const std::unique_ptr<method::Method> method = options.method.kind->open(options.method.settings);
  method->prepare({occluders, question});
  result.build_seconds = occluders.build_seconds();

  const std::vector<Receiver> receivers = vertex_receivers(mesh);
  result.batch = method::run_batch(*method, question.ray_count, receivers,
                                   {.progress = progress.watch("casting rays", receivers.size())});
  result.remarks = method->remarks();
  progress.clear();
  return result;
}

void write_mesh(const std::string& path, const Bake& result) {
  std::vector<float> occlusion = result.batch.occlusion;
  for (float& value : occlusion) value = std::isnan(value) ? 0 : value;  // vertices without a usable normal
  std::ofstream file(path, std::ios::binary);
  scene::write_ply(file, result.scene.mesh, occlusion);
  file.close();
  if (!file) throw std::runtime_error(fmt::format("cannot write '{}'", path));
}

std::size_t receiver_count(const Bake& result) {
  return result.batch.occlusion.size() - result.batch.invalid_receiver_count;
}

Json document_of(const BakeOptions& options, const Bake& result) {
  Json document;
  document["method"] = options.method.kind->word;
  document["scene"] = options.scene.name;
  document["radius"] = result.radius;
  document["samples"] = options.occlusion.ray_count;
  document["vertices"] = result.batch.occlusion.size();
  document["receivers"] = receiver_count(result);
  add_batch_keys(document, *options.method.kind, result.batch);
  document["vertices_without_normal"] = result.batch.invalid_receiver_count;
  add_setting_keys(document, options.occlusion);
  add_remark_keys(document, result.remarks);
  add_scene_keys(document, result.scene);
  add_surroundings_keys(document, options.scene, result.scene);
  document["build_seconds"] = result.build_seconds;
  return document;
}

void print_table(const BakeOptions& options, const Bake& result) {
  Table table;
  add_scene_row(table, result.scene);
  add_surroundings_row(table, options.scene, result.scene);
  table.add("prepared",
            fmt::format("{:.3f} s to load, {:.3f} s to build", result.scene.load_seconds, result.build_seconds));
  table.add("receivers",
            fmt::format("{} of {} vertices", grouped(receiver_count(result)), grouped(result.batch.occlusion.size())));
  add_batch_rows(table, *options.method.kind, result.batch);
  table.add("wrote", options.output);
  table.print();
}

void report_vertices_without_normal(const Bake& result) {
  const std::size_t count = result.batch.invalid_receiver_count;
  if (count == 0) return;
  fmt::print(stderr, "lkao: {}: {} without a usable normal {} occlusion 0\n", result.scene.name,
             count == 1 ? "1 vertex" : fmt::format("{} vertices", count), count == 1 ? "gets" : "get");
}

void bake(const BakeOptions& options) {
  if (ending_of(options.output) != ".ply") {
    throw std::invalid_argument(fmt::format("--output: expected a name ending in .ply, got '{}'", options.output));
  }
  check_lengths(options.method, options.occlusion);
  OutputFiles outputs(options.scene.inputs());
  const std::string mesh_path = outputs.claim(options.output);
  const JsonOutput json(options.common.json_path, outputs);

  ProgressBar progress(!options.common.quiet);
  const Bake result = compute(options, progress);
  report_vertices_without_normal(result);
  report_fully_blocked(result.scene, "vertices", result.batch, result.radius);
  write_mesh(mesh_path, result);
  json.write_and_commit(document_of(options, result));
  if (options.common.wants_table()) print_table(options, result);
}

void add_options(CLI::App& app, BakeOptions& options) {
  add_scene_options(app, options.scene, "gets nothing");
  add_parsed(app, "--up", options.up, parse_vector, "What is up, for --ground (default: 0,1,0)")->type_name("X,Y,Z");
  app.add_option("-o,--output", options.output, "Mesh: a .ply with occlusion and grey colour per vertex")
      ->required()
      ->type_name("FILE");
  add_occlusion_options(app, options.occlusion);
  method::add_setting_options(app, options.method.settings, {options.method.kind});
  add_common_options(app, options.common);
  app.footer("Vertices keep their numbers. Those without a usable normal get occlusion 0 and are counted.");
}

}  // namespace

Command add_bake_command(CLI::App& program) {
  const auto options = std::make_shared<BakeOptions>();
  CLI::App* const app = program.add_subcommand("bake", "Bake occlusion into the vertices of a mesh");
  add_options(*app, *options);
  const auto run = [options] {
    with_threads(options->common.thread_count, [&] { bake(*options); });
    return kSuccess;
  };
  return {app, run};
}

}  // namespace lkao::cli
