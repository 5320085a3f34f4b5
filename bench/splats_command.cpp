// lkao-bench splats: spheres of pixels and of the scene against rays. Shanmugam & Arikan 2007 show pictures alone.
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "bench/commands.h"
#include "bench/csv_file.h"
#include "bench/drawn_method.h"
#include "bench/options.h"
#include "bench/radii.h"
#include "bench/study_scenes.h"
#include "method/gl_device.h"
#include "method/list.h"
#include "method/setting_options.h"

namespace lkao::bench {
namespace {

struct SplatsVariant {
  const char* name;
  ChangedSettings settings;
};

std::vector<SplatsVariant> splats_variants() {
  return {{"near; 1 layer", {{"halves", "near"}, {"layers", "1"}}},
          {"near; 2 layers", {{"halves", "near"}}},
          {"far", {{"halves", "far"}}},
          {"both", {}},
          {"both; pixel sphere 0.35", {{"pixel-sphere", "0.35"}}},
          {"both; exact formula", {{"formula", "exact"}}},
          {"both; as printed", {{"formula", "printed"}, {"inside", "everything"}}}};
}

Columns splats_csv_columns() {
  return {{"scene"},
          {"radius", "{:.6g}"},
          {"variant"},
          {"milliseconds", "{:.5g}"},
          {"far_fragments_a_pixel", "{:.5g}"},
          {"mean_of_rays", "{:.4g}"},
          {"mean_change", "{:.4g}"},
          {"mae", "{:.4g}"},
          {"rmse", "{:.4g}"}};
}

Columns splats_table_columns() {
  return {{"scene", "{}", -12},
          {"radius", "{:.4g}", 7},
          {"variant", "{}", -24},
          kBar,
          {"milliseconds", "{:.1f}", 8, "ms"},
          {"far_fragments_a_pixel", "{:.1f}", 8, "fill"},
          kBar,
          {"mean_of_rays", "{:.4f}", 7, "rays"},
          {"mean_change", "{:+.4f}", 8, "change"},
          {"mae", "{:.4f}", 7, "MAE"},
          {"rmse", "{:.4f}", 7, "RMSE"}};
}

struct SplatsOptions {
  StudySceneOptions scenes = {.views = {}, .meshes = {}, .names = {}, .width = 512, .height = 384};
  method::Settings settings;          // the device
  std::vector<method::Radius> radii;  // empty: the scene's own
  int turn_count = 1;
  std::string csv;
};

double far_fragments(const nlohmann::ordered_json& keys) {
  return keys.contains("far") ? keys.at("far").at("fragments_per_pixel").get<double>() : 0;
}

class SplatsStudy {
 public:
  explicit SplatsStudy(const SplatsOptions& options)
      : options_(options),
        names_(study_scene_names(options.scenes)),
        csv_(options.csv, splats_csv_columns(),
             device_notes(method::method_named("splat").open(options.settings)->device())) {}

  void run() {
    fmt::print("{} x {} pixels, against {} rays\n{}", options_.scenes.width, options_.scenes.height,
               options_.turn_count * kMaxRayCount, table_heading(columns_));
    for (const std::string& name : names_) {
      const StudyScene scene = load_study_scene(name, options_.scenes);
      for (const float radius : options_.radii.empty() ? scene.radii : lengths_of(options_.radii, scene)) {
        const std::vector<float> rays = cast_rays(scene, radius, Falloff::constant(), options_.turn_count);
        for (const SplatsVariant& variant : splats_variants()) report(scene, radius, variant, rays);
      }
    }
  }

 private:
  void report(const StudyScene& scene, float radius, const SplatsVariant& variant, const std::vector<float>& rays) {
    const DrawnResult drawn = draw_method("splat", scene, radius, Falloff::constant(),
                                          settings_of("splat", variant.settings, options_.settings), rays);
    const Measurement measurement = {{"scene", scene.name},
                                     {"radius", radius},
                                     {"variant", variant.name},
                                     {"milliseconds", drawn.milliseconds},
                                     {"far_fragments_a_pixel", far_fragments(drawn.keys)},
                                     {"mean_of_rays", mean_of(rays)},
                                     {"mean_change", drawn.off.mean_change},
                                     {"mae", drawn.off.error.mae},
                                     {"rmse", drawn.off.error.rmse}};
    csv_.write(measurement);
    fmt::print("{}", table_row(columns_, measurement));
    std::fflush(stdout);
  }

  SplatsOptions options_;
  std::vector<std::string> names_;
  CsvFile csv_;
  const Columns columns_ = splats_table_columns();
};

}  // namespace

Command add_splats_command(CLI::App& program) {
  auto options = std::make_shared<SplatsOptions>();
  CLI::App* app =
      program.add_subcommand("splats", "Spheres of pixels and of the scene: errors against rays, and fill.");
  add_scene_options(*app, options->scenes);
  add_radii_option(*app, "--radii", options->radii,
                   "AO radii: lengths or 5% of the scene's diagonal (default: each scene's own)");
  add_size_options(*app, options->scenes);
  app->add_option("--turns", options->turn_count, "rays a receiver, in thousands (1024)")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  method::add_setting_option(*app, options->settings, method::device_setting());
  add_csv_option(*app, options->csv);
  return {app, [options] {
            SplatsStudy(*options).run();
            return 0;
          }};
}

}  // namespace lkao::bench
