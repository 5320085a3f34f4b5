// lkao render: an image of the occlusion that a camera sees.
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/json_output.h"
#include "cli/light_option.h"
#include "cli/method_options.h"
#include "cli/normals_option.h"
#include "cli/options.h"
#include "cli/output_files.h"
#include "cli/parse.h"
#include "cli/parsed_option.h"
#include "cli/progress_bar.h"
#include "cli/render_images.h"
#include "cli/rendering.h"
#include "cli/report.h"

namespace lkao::cli {
namespace {

struct RenderOptions {
  std::string output;
  std::string preview;
  RenderingOptions rendering;
  CommonOptions common;
};

Json camera_json(const scene::Camera& camera, const glm::dvec3& origin) {
  return {{"eye", position_json(camera.eye, origin)},
          {"target", position_json(camera.target, origin)},
          {"up", vector_json(camera.up)},
          {"fov", camera.fov}};
}

Json document_of(const RenderingOptions& options, const Rendering& result) {
  Json document;
  document["method"] = options.method.kind->word;
  document["scene"] = options.scene.name;
  document["radius"] = result.radius;
  document["samples"] = options.occlusion.ray_count;
  document["width"] = options.size.width;
  document["height"] = options.size.height;
  document["receivers"] = result.view.receiver_count;
  add_batch_keys(document, *options.method.kind, result.batch, result.batch.occlusion_mean());
  document["invalid_receivers"] = result.batch.invalid_receiver_count;
  add_setting_keys(document, options.occlusion);
  add_remark_keys(document, result.remarks);
  document["normals"] = word_of(kNormalSourceWords, result.normals);
  document["camera"] = camera_json(result.camera, result.scene.mesh.origin);
  add_scene_keys(document, result.scene);
  add_surroundings_keys(document, options.scene, result.scene);
  if (options.light) {
    document["light"] = light_json(*options.light);
    document["visibility_mean"] = 1 - result.batch.occlusion_mean();
  }
  if (result.chain) document["lod"] = lod_json(*result.chain, static_cast<float>(result.radius), result.lod_seconds);
  document["build_seconds"] = result.build_seconds;
  for (const auto& [word, seconds] : result.own_build_seconds) document[word + "_build_seconds"] = seconds;
  document["camera_seconds"] = result.camera_seconds;
  return document;
}

void print_table(const RenderOptions& options, const Rendering& result) {
  const Size& size = options.rendering.size;
  Table table;
  add_scene_row(table, result.scene);
  add_surroundings_row(table, options.rendering.scene, result.scene);
  table.add("prepared", fmt::format("{:.3f} s to load, {:.3f} s to build, {:.3f} s to find receivers",
                                    result.scene.load_seconds, result.build_seconds, result.camera_seconds));
  table.add("receivers",
            fmt::format("{} in {} x {} pixels", grouped(result.view.receiver_count), size.width, size.height));
  if (result.chain) {
    add_lod_row(table, *result.chain, static_cast<float>(result.radius), result.lod_seconds);
  }
  add_remark_rows(table, result.remarks);
  add_batch_rows(table, *options.rendering.method.kind, result.batch, result.batch.occlusion_mean());
  if (options.rendering.light) {
    table.add("mean visibility", fmt::format("{:.4f} of the light", 1 - result.batch.occlusion_mean()));
  }
  table.add("wrote", options.output + (options.preview.empty() ? "" : ", " + options.preview));
  table.print();
}

// What is asked of the method, and of the one it is checked against, must be among their abilities.
void check_abilities(const RenderingOptions& options) {
  check_question(options.method, options.occlusion);
  if (options.reference) {
    check_question({&method::reference_of(*options.method.kind), options.method.settings}, options.occlusion);
  }
  if (options.lod) require_ability(options.method, &method::Abilities::levels, "--lod");
  if (options.layers.bent_normals) require_ability(options.method, &method::Abilities::bent_normals, "--bent-normals");
}

// Rays to a light have lengths and weights of their own.
void check_light(const RenderingOptions& options) {
  if (!options.light) return;
  require_ability(options.method, &method::Abilities::lights, "--light");
  const OcclusionOptions& occlusion = options.occlusion;
  const std::pair<const char*, bool> others[] = {{"--radius", occlusion.radius.has_value()},
                                                 {"--falloff", occlusion.falloff.name() != "constant"},
                                                 {"--weighting", occlusion.weighting != Weighting::cosine},
                                                 {"--min-distance", occlusion.min_distance > 0},
                                                 {"--lod", options.lod.has_value()},
                                                 {"--bent-normals", options.layers.bent_normals}};
  for (const auto& [name, is_given] : others) {
    if (is_given) throw std::invalid_argument(fmt::format("--light has no use for {}: rays end at the light", name));
  }
}

// Levels of a file are those of the scene alone, as it is there.
void check_levels(const RenderingOptions& options) {
  if (!options.lod || options.lod->file.empty()) return;
  if (!options.scene.flip && !options.scene.has_surroundings()) return;
  throw std::invalid_argument(fmt::format(
      "--lod: the levels of '{}' know nothing of --flip, --ground and --blockers; --lod k=3 makes some that do",
      options.lod->file));
}

// Faults of the options that need no scene to be seen.
void check_options(const RenderOptions& options) {
  const bool is_png = ending_of(options.output) == ".png";
  if (is_png && options.rendering.layers.any()) {
    throw std::invalid_argument(
        fmt::format("'{}': a PNG holds the visibility only; --bent-normals, --depth and --normal-channels need an .exr",
                    options.output));
  }
  if (!options.preview.empty() && ending_of(options.preview) != ".png") {
    throw std::invalid_argument(fmt::format("--preview: expected a name ending in .png, got '{}'", options.preview));
  }
  check_method(options.rendering.method);
  check_abilities(options.rendering);
  check_light(options.rendering);
  check_levels(options.rendering);
  check_part(options.rendering.parts, options.rendering.method);
  if (options.rendering.parts.part && options.rendering.reference) {
    throw std::invalid_argument(
        "--part: what a part is checked against would not be in its file; leave out --reference");
  }
  const CameraOptions& camera = options.rendering.camera;
  if (camera.eye && camera.target && *camera.eye == *camera.target) {
    throw std::invalid_argument("--eye and --target are the same point");
  }
}

void report_oddities(const Rendering& result) {
  if (result.view.receiver_count == 0) {
    fmt::print(stderr, "lkao: {}: the camera sees no triangle, the image is all background\n", result.scene.name);
  }
  if (result.batch.invalid_receiver_count > 0) {
    fmt::print(stderr, "lkao: {}: {} receivers without a usable normal are NaN\n", result.scene.name,
               result.batch.invalid_receiver_count);
  }
  report_fully_blocked(result.scene, "points that the camera sees", result.batch, result.radius);
}

void render_part(RenderOptions options) {
  RenderingOptions& rendering = options.rendering;
  answer_part(rendering.parts, options.output, options.common, rendering.scene.inputs(),
              [&](ProgressBar& progress) { return compute_rendering(rendering, progress).batch; });
}

void render(const RenderOptions& options) {
  check_options(options);
  if (options.rendering.parts.part) return render_part(options);
  OutputFiles outputs(options.rendering.parts.with_merged(options.rendering.scene.inputs()));
  const std::string image_path = outputs.claim_image(options.output);
  const std::string preview_path = options.preview.empty() ? "" : outputs.claim_image(options.preview);
  const JsonOutput json(options.common.json_path, outputs);

  ProgressBar progress(!options.common.quiet);
  const Rendering result = compute_rendering(options.rendering, progress);
  report_oddities(result);

  progress.begin("writing " + options.output);
  ImageLayers layers = options.rendering.layers;
  layers.visibility = options.rendering.light.has_value();
  write_rendering(image_path, result.view, result.batch, layers);
  if (!preview_path.empty()) write_rendering(preview_path, result.view, result.batch, {});
  progress.clear();
  json.write_and_commit(document_of(options.rendering, result));
  if (options.common.wants_table()) print_table(options, result);
}

void add_options(CLI::App& app, RenderOptions& options) {
  RenderingOptions& rendering = options.rendering;
  add_scene_options(app, rendering.scene, "is seen too");
  app.add_option("-o,--output", options.output, "Image: .exr holds float channels, .png a preview of the visibility")
      ->required()
      ->type_name("FILE");
  app.add_option("--preview", options.preview, "A .png preview of the visibility beside the output")->type_name("FILE");
  add_parsed(app, "--size", rendering.size, parse_size, "Pixels (default: 1024x768)")->type_name("WxH");
  add_camera_options(app, rendering.camera);
  add_occlusion_options(app, rendering.occlusion);
  add_normals_option(app, rendering.normals);
  add_method_options(app, rendering.method);
  add_parsed(
      app, "--lod", rendering.lod, parse_lod,
      "Simplified occluders where only distance sees them: k=3,levels=4,epsilon=E,growth=3, any of them left out "
      "(epsilon: from the radius, or where that is infinite from the scene's diagonal), or a file of lkao simplify. "
      "With --reference: against the whole scene")
      ->type_name("KEY=NUMBER,...|FILE");
  add_parsed(
      app, "--light", rendering.light, parse_light,
      "Soft shadows of a sphere, or with a normal of a disc, instead of ambient occlusion: which share of it is "
      "seen, of a disc by area, of a sphere by solid angle. Takes no --radius; --samples are points of the light")
      ->type_name("X,Y,Z,RADIUS[,NX,NY,NZ]");
  app.add_flag("--reference", rendering.reference,
               "Cast the same rays through Embree too (where it is the method: by bvh) and count differences");
  app.add_flag("--bent-normals", rendering.layers.bent_normals, "Add the channels bent.X, bent.Y, bent.Z (.exr)");
  app.add_flag("--depth", rendering.layers.depth, "Add the channel depth.Z: infinity where nothing is seen (.exr)");
  app.add_flag("--normal-channels", rendering.layers.normals, "Add the channels normal.X, normal.Y, normal.Z (.exr)");
  add_part_options(app, rendering.parts);
  add_common_options(app, options.common);
  app.footer(
      "An .exr has the channel occlusion: 0 is open, 1 fully blocked, and 0 where nothing is seen. With --light it is "
      "visibility instead: 1 sees all of the light, 0 nothing of it; and 1 where nothing is seen.");
}

}  // namespace

Command add_render_command(CLI::App& program) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App* const app = program.add_subcommand("render", "Render the occlusion that a camera sees");
  add_options(*app, *options);
  const auto run = [options] {
    with_threads(options->common.thread_count, [&] { render(*options); });
    return kSuccess;
  };
  return {app, run};
}

}  // namespace lkao::cli
