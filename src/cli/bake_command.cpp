// lkao bake: occlusion per vertex, corner, face or texel of a mesh.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "cli/baking.h"
#include "cli/commands.h"
#include "cli/gltf_output.h"
#include "cli/json_output.h"
#include "cli/method_options.h"
#include "cli/normals_option.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/parse.h"
#include "cli/parsed_option.h"
#include "cli/progress_bar.h"
#include "cli/report.h"
#include "cli/texture_baking.h"
#include "cli/texture_files.h"
#include "cli/texture_options.h"
#include "cli/texture_report.h"
#include "method/setting_options.h"
#include "scene/obj_writer.h"
#include "scene/ply_writer.h"

namespace lkao::cli {
namespace {

using bake::Per;

constexpr method::Word<Per> kPerWords[] = {{"vertex", Per::vertex}, {"corner", Per::corner}, {"face", Per::face}};
constexpr method::Word<scene::GltfAttribute> kAttributeWords[] = {{"occlusion", scene::GltfAttribute::occlusion},
                                                                  {"color", scene::GltfAttribute::colour}};
constexpr method::Word<Filter> kFilterWords[] = {{"none", Filter::none}, {"least-squares", Filter::least_squares}};

struct BakeOptions {
  std::string output;
  BakingOptions baking;
  scene::OcclusionProperties properties;
  bool linear = false;
  std::optional<scene::GltfAttribute> attribute;
  TextureSettings texture;
  CommonOptions common;

  bool wants_obj() const { return ending_of(output) == ".obj"; }
  bool wants_gltf() const { return is_gltf(output); }
  scene::GltfAttribute attribute_or_default() const { return attribute.value_or(scene::GltfAttribute::occlusion); }
};

void write_mesh(const std::string& path, const BakeOptions& options, const Baking& result) {
  const scene::Mesh& mesh = result.scene.mesh;
  std::vector<float> occlusion = result.batch.occlusion;
  for (float& value : occlusion) value = std::isnan(value) ? 0 : value;
  std::ofstream file(path, std::ios::binary);
  if (options.wants_obj()) {
    scene::write_obj(file, mesh, occlusion, options.properties.coding);
  } else if (options.baking.per == Per::face) {
    scene::write_ply_of_faces(file, mesh, occlusion, options.properties);
  } else {
    scene::write_ply(file, mesh, occlusion, options.properties);
  }
  file.close();
  if (!file) throw std::runtime_error(fmt::format("cannot write '{}'", path));
}

Json document_of(const BakingOptions& options, const Baking& result) {
  Json document;
  document["method"] = options.method.kind->word;
  document["scene"] = options.scene.name;
  document["radius"] = result.radius;
  document["samples"] = options.occlusion.ray_count;
  document["per"] = word_of(kPerWords, options.per);
  document["filter"] = word_of(kFilterWords, options.filter);
  document["normals"] = word_of(kNormalSourceWords, result.normals);
  document["vertices"] = result.scene.mesh.positions.size();
  document["receivers"] = result.receiver_count;
  add_batch_keys(document, *options.method.kind, result.batch, result.batch.occlusion_mean());
  document["vertices_without_normal"] = options.per == Per::face ? 0 : result.bare_count;
  add_setting_keys(document, options.occlusion);
  add_remark_keys(document, result.remarks);
  add_scene_keys(document, result.scene);
  add_surroundings_keys(document, options.scene, result.scene);
  document["build_seconds"] = result.build_seconds;
  return document;
}

void print_table(const BakeOptions& options, const Baking& result) {
  Table table;
  add_scene_row(table, result.scene);
  add_surroundings_row(table, options.baking.scene, result.scene);
  table.add("prepared",
            fmt::format("{:.3f} s to load, {:.3f} s to build", result.scene.load_seconds, result.build_seconds));
  table.add("normals", std::string(word_of(kNormalSourceWords, result.normals)));
  table.add("receivers", fmt::format("{} for {} {}", grouped(result.receiver_count),
                                     grouped(result.batch.occlusion.size() - result.bare_count),
                                     options.baking.per == Per::face ? "faces" : "vertices"));
  add_batch_rows(table, *options.baking.method.kind, result.batch, result.batch.occlusion_mean());
  table.add("wrote", options.output);
  table.print();
}

void report_oddities(const BakeOptions& options, const Baking& result) {
  const std::size_t count = result.bare_count;
  if (count > 0 && options.baking.per != Per::face) {
    fmt::print(stderr, "lkao: {}: {} without a usable normal {} occlusion 0\n", result.scene.name,
               count == 1 ? "1 vertex" : fmt::format("{} vertices", count), count == 1 ? "gets" : "get");
  }
  report_fully_blocked(result.scene, options.baking.per == Per::face ? "faces" : "vertices", result.batch,
                       result.radius);
  const glm::dvec3& origin = result.scene.mesh.origin;
  if (origin != glm::dvec3(0.0) && !options.wants_obj() && !options.wants_gltf()) {
    fmt::print(stderr, "lkao: {}: coordinates are less the origin {:.17g} {:.17g} {:.17g}, which its header names\n",
               options.output, origin.x, origin.y, origin.z);
  }
}

// A model that is written as it was read keeps its vertices.
void check_gltf_options(const BakeOptions& options) {
  if (options.attribute && !options.wants_gltf()) {
    throw std::invalid_argument("--attribute is for a .gltf or .glb");
  }
  if (!options.wants_gltf()) return;
  if (options.baking.per != Per::vertex) {
    throw std::invalid_argument(fmt::format("--per {}: a .gltf or .glb has values of vertices alone; write a .ply",
                                            word_of(kPerWords, options.baking.per)));
  }
  if (options.properties.quality) throw std::invalid_argument("--quality is for a .ply");
}

// Faults of the options that need no scene to be seen.
void check_options(const BakeOptions& options) {
  check_question(options.baking.method, options.baking.occlusion);
  if (options.texture.size) return check_texture_output(options.output, options.texture);
  const bool is_obj = options.wants_obj();
  if (!is_obj && !options.wants_gltf() && ending_of(options.output) != ".ply") {
    throw std::invalid_argument(
        fmt::format("--output: expected a name ending in .ply, .obj, .gltf or .glb, got '{}'", options.output));
  }
  check_gltf_options(options);
  if (is_obj && options.properties.quality) {
    throw std::invalid_argument("--quality: an .obj has colours alone; write a .ply");
  }
  if (is_obj && options.baking.per == Per::face) {
    throw std::invalid_argument("--per face: an .obj has colours of vertices alone; write a .ply");
  }
  if (options.baking.per == Per::face && options.baking.filter != Filter::none) {
    throw std::invalid_argument("--filter least-squares is for --per vertex and corner, not for --per face");
  }
}

// What is written as it was read; null for other files.
std::unique_ptr<scene::GltfFile> open_model(const BakeOptions& options) {
  if (!options.wants_gltf()) return nullptr;
  std::unique_ptr<scene::GltfFile> model = open_gltf(options.baking.scene.name, options.output);
  if (!options.texture.size) model->check_vertices(options.attribute_or_default());
  return model;
}

std::vector<std::string> inputs_of(const BakeOptions& options) {
  std::vector<std::string> inputs = options.baking.parts.with_merged(options.baking.scene.inputs());
  if (!options.texture.detailed.empty()) inputs.push_back(options.texture.detailed);
  return inputs;
}

void bake_part(BakeOptions options) {
  BakingOptions& baking = options.baking;
  answer_part(baking.parts, options.output, options.common, inputs_of(options), [&](ProgressBar& progress) {
    return options.texture.size ? compute_texture_baking(baking, options.texture, progress).baking.batch
                                : compute_baking(baking, progress).batch;
  });
}

void bake_textures(const BakeOptions& options) {
  const std::unique_ptr<scene::GltfFile> model = open_model(options);
  OutputFiles outputs(inputs_of(options));
  const JsonOutput json(options.common.json_path, outputs);

  ProgressBar progress(!options.common.quiet);
  const TextureBaking result = compute_texture_baking(options.baking, options.texture, progress);
  report_texture_oddities(result);
  const std::vector<std::string> written =
      write_textures(options.output, result, options.texture, model.get(), outputs);
  json.write_and_commit(texture_document(options.baking, options.texture, result));
  if (options.common.wants_table()) print_texture_table(options.baking, options.texture, result, written);
}

void bake(const BakeOptions& options) {
  check_options(options);
  if (options.baking.parts.part) return bake_part(options);
  if (options.texture.size) return bake_textures(options);
  const std::unique_ptr<scene::GltfFile> model = open_model(options);
  OutputFiles outputs(inputs_of(options));
  const std::string mesh_path = outputs.claim(options.output);
  const JsonOutput json(options.common.json_path, outputs);

  ProgressBar progress(!options.common.quiet);
  const Baking result = compute_baking(options.baking, progress);
  report_oddities(options, result);
  if (model) {
    const scene::GltfOutput output =
        model->with_vertices(result.scene.contents, result.batch.occlusion, options.attribute_or_default());
    for (const std::string& remark : output.remarks) fmt::print(stderr, "lkao: {}: {}\n", options.output, remark);
    write_gltf(output, options.output, mesh_path, outputs);
  } else {
    write_mesh(mesh_path, options, result);
  }
  json.write_and_commit(document_of(options.baking, result));
  if (options.common.wants_table()) print_table(options, result);
}

void add_baking_options(CLI::App& app, BakingOptions& options) {
  add_occlusion_options(app, options.occlusion);
  add_normals_option(app, options.normals);
  add_parsed(
      app, "--per", options.per, [](const std::string& text) { return method::parse_word(kPerWords, text); },
      "What gets a value each: vertex; corner, where vertices are split along creases; or face (default: vertex)")
      ->type_name(method::join(method::list_words(kPerWords), "|"));
  add_parsed(
      app, "--filter", options.filter, [](const std::string& text) { return method::parse_word(kFilterWords, text); },
      "Values of vertices: none, the occlusion at the vertex; or least-squares, what fits all of the faces best, for "
      "coarse meshes (default: none)")
      ->type_name(method::join(method::list_words(kFilterWords), "|"));
  method::add_setting_options(app, options.method.settings, {options.method.kind});
}

void add_options(CLI::App& app, BakeOptions& options) {
  add_scene_options(app, options.baking.scene, "gets nothing");
  CLI::Option* const own_object = app.add_flag(
      "--own-object", options.baking.scene.own_object,
      "Each object is blocked by its own triangles alone, as if the others were far away: what a node of a "
      "glTF shows, or what an .obj has under one name of \"o\", or of \"g\" where it has no \"o\"");
  for (const char* name : {"--ground", "--blockers"}) own_object->excludes(app.get_option(name));
  add_parsed(app, "--up", options.baking.up, parse_vector, "What is up, for --ground (default: 0,1,0)")
      ->type_name("X,Y,Z");
  app.add_option(
         "-o,--output", options.output,
         "Mesh: a .ply with occlusion and grey colour, or an .obj with grey colour; grey is the visibility, 1 "
         "less the occlusion, in sRGB. Of a .gltf or .glb another, with all that it has and the attribute. With "
         "--texture: an image, .png or .exr, or a .gltf or .glb with the map in it")
      ->required()
      ->type_name("FILE");
  app.add_flag("--linear", options.linear, "Grey without the curve of sRGB");
  app.add_flag("--quality", options.properties.quality, "Add the property quality, the visibility, for MeshLab (.ply)");
  add_parsed(
      app, "--attribute", options.attribute,
      [](const std::string& text) { return method::parse_word(kAttributeWords, text); },
      "Of a .gltf or .glb: occlusion (_OCCLUSION), or color (COLOR_0, the visibility, linear; viewers show it) "
      "(default: occlusion)")
      ->type_name(method::join(method::list_words(kAttributeWords), "|"));
  add_baking_options(app, options.baking);
  add_texture_options(app, options.texture);
  add_part_options(app, options.baking.parts);
  add_common_options(app, options.common);
  app.footer(
      "Every corner of a triangle is a receiver, a little inside the triangle, and casts --samples rays; a vertex has "
      "the mean of its corners, weighted by their angles. With --per face and --filter least-squares receivers are "
      "spread over the faces, 4 or more on each.\n"
      "Vertices keep their numbers. Those without a usable normal get occlusion 0 and are counted.");
}

}  // namespace

Command add_bake_command(CLI::App& program) {
  const auto options = std::make_shared<BakeOptions>();
  CLI::App* const app = program.add_subcommand("bake", "Bake occlusion into the vertices, faces or textures of a mesh");
  add_options(*app, *options);
  const auto run = [options] {
    if (options->texture.size) options->baking.scene.uv_set = options->texture.uv_set;
    options->properties.coding = options->linear ? scene::ColourCoding::linear : scene::ColourCoding::srgb;
    with_threads(options->common.thread_count, [&] { bake(*options); });
    return kSuccess;
  };
  return {app, run};
}

}  // namespace lkao::cli
