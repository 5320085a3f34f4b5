// lkao-bench volumes: ambient occlusion volumes against rays of linear falloff. Figures 7, 9 and 10 of McGuire 2010.
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "bench/commands.h"
#include "bench/csv_file.h"
#include "bench/options.h"
#include "bench/radii.h"
#include "bench/study_scenes.h"
#include "bench/volumes_study.h"
#include "method/gl_device.h"
#include "method/list.h"
#include "method/setting_options.h"

namespace lkao::bench {
namespace {

struct VolumesVariant {
  std::string name;
  ChangedSettings settings;
};

std::vector<VolumesVariant> deltas() {
  std::vector<VolumesVariant> variants;
  for (const char* delta : {"0.4", "0.5", "0.6", "0.7", "0.8", "1", "1.25"}) {
    variants.push_back({fmt::format("delta {} of the radius", delta), {{"accessibility", "32"}, {"delta", delta}}});
  }
  return variants;
}

std::vector<VolumesVariant> formats() {
  return {{"8 bits (the paper's)", {{"accessibility", "8"}}},
          {"16 bits", {{"accessibility", "16"}}},
          {"32 bits", {{"accessibility", "32"}}}};
}

std::vector<VolumesVariant> clamps() { return {{"clamped", {}}, {"not clamped", {{"clamp", "off"}}}}; }

std::vector<VolumesVariant> compensations() { return {{"raw", {}}, {"compensated", {{"compensation", "fitted"}}}}; }

std::vector<VolumesVariant> volume_back_ends() {
  std::vector<VolumesVariant> variants;
  for (const char* volumes : {"every_frame", "kept"}) {
    for (const char* geometry : {"vertex_pulling", "geometry_shader"}) {
      variants.push_back({fmt::format("{} + {}", volumes, geometry), {{"volumes", volumes}, {"geometry", geometry}}});
    }
  }
  return variants;
}

std::vector<VolumesVariant> sparse() {
  return {{"all pixels", {}}, {"one of 2 x 2", {{"sparse", "2"}}}, {"one of 3 x 3", {{"sparse", "3"}}}};
}

constexpr method::Word<std::vector<VolumesVariant> (*)()> kVolumeStudies[] = {{"deltas", deltas},
                                                                              {"formats", formats},
                                                                              {"clamps", clamps},
                                                                              {"compensations", compensations},
                                                                              {"back_ends", volume_back_ends},
                                                                              {"sparse", sparse}};

Columns volumes_csv_columns() {
  return {{"scene"},
          {"triangles"},
          {"radius", "{:.6g}"},
          {"study"},
          {"variant"},
          {"milliseconds", "{:.5g}"},
          {"fragments", "{:.5g}"},
          {"fragments_inside", "{:.5g}"},
          {"fragments_blended", "{:.5g}"},
          {"mae", "{:.4g}"},
          {"rmse", "{:.4g}"},
          {"mean_change", "{:.4g}"},
          {"log_error", "{:.4g}"}};
}

Columns volumes_table_columns() {
  return {{"scene", "{}", -12},
          {"triangles", "{}", 9},
          {"radius", "{:.4g}", 7},
          {"variant", "{}", -28},
          kBar,
          {"milliseconds", "{:.1f}", 8, "ms"},
          {"fragments", "{:.1f}", 8, "fill"},
          {"fragments_inside", "{:.1f}", 8, "inside"},
          {"fragments_blended", "{:.1f}", 8, "blended"},
          kBar,
          {"mae", "{:.4f}", 7, "MAE"},
          {"rmse", "{:.4f}", 7, "RMSE"},
          {"mean_change", "{:+.4f}", 8, "change"},
          {"log_error", "{:.3f}", 7, "Eq. 14"}};
}

struct VolumesOptions {
  StudySceneOptions scenes = {.views = {}, .meshes = {}, .names = {}, .width = 160, .height = 120};
  method::Settings settings;          // the device
  std::vector<method::Radius> radii;  // empty: the scene's own
  std::vector<std::string> studies = list_words(kVolumeStudies);
  int turn_count = 5;
  bool fits = false;
  std::string csv;
};

class VolumeStudies {
 public:
  explicit VolumeStudies(const VolumesOptions& options)
      : options_(options),
        names_(study_scene_names(options.scenes)),
        csv_(options.csv, volumes_csv_columns(),
             device_notes(method::method_named("volumes").open(options.settings)->device())) {}

  void run() {
    fmt::print("{} x {} pixels, against {} rays\n{}", options_.scenes.width, options_.scenes.height,
               options_.turn_count * kMaxRayCount, table_heading(columns_));
    for (const std::string& name : names_) study_scene(load_study_scene(name, options_.scenes));
    if (!options_.fits) return;
    const glm::dvec3 curve = fit_.curve();
    fmt::print("compensation: {:.4f} o {:+.4f} o^2 {:+.4f} o^3, which ends at {:.3f}\n", curve.x, curve.y, curve.z,
               curve.x + curve.y + curve.z);
  }

 private:
  void study_scene(const StudyScene& scene) {
    for (const float radius : options_.radii.empty() ? scene.radii : lengths_of(options_.radii, scene)) {
      const std::vector<float> rays = cast_rays(scene, radius, Falloff::linear(), options_.turn_count);
      for (const std::string& study : options_.studies) {
        for (const VolumesVariant& variant : parse_word(kVolumeStudies, study)()) {
          report(scene, radius, study, variant.name, draw(scene, radius, variant.settings, rays));
        }
      }
      if (options_.fits) fit_.add(draw(scene, radius, {{"accessibility", "32"}}, rays).occlusion, rays);
    }
  }

  VolumesResult draw(const StudyScene& scene, float radius, const ChangedSettings& settings,
                     const std::vector<float>& rays) const {
    return draw_volumes(scene, radius, settings_of("volumes", settings, options_.settings), rays);
  }

  void report(const StudyScene& scene, float radius, const std::string& study, const std::string& variant,
              const VolumesResult& result) {
    const Measurement measurement = {{"scene", scene.name},
                                     {"triangles", scene.mesh.triangles.size()},
                                     {"radius", radius},
                                     {"study", study},
                                     {"variant", variant},
                                     {"milliseconds", result.milliseconds},
                                     {"fragments", result.fill},
                                     {"fragments_inside", result.inside},
                                     {"fragments_blended", result.blended},
                                     {"mae", result.off.error.mae},
                                     {"rmse", result.off.error.rmse},
                                     {"mean_change", result.off.mean_change},
                                     {"log_error", result.log_error}};
    csv_.write(measurement);
    fmt::print("{}", table_row(columns_, measurement));
    std::fflush(stdout);
  }

  VolumesOptions options_;
  std::vector<std::string> names_;
  CsvFile csv_;
  CompensationFit fit_;
  const Columns columns_ = volumes_table_columns();
};

}  // namespace

Command add_volumes_command(CLI::App& program) {
  auto options = std::make_shared<VolumesOptions>();
  CLI::App* app = program.add_subcommand("volumes", "Ambient occlusion volumes: errors against rays, and fill.");
  add_scene_options(*app, options->scenes);
  add_radii_option(*app, "--radii", options->radii,
                   "radii of the rays: lengths or 5% of the scene's diagonal (default: each scene's own)");
  add_size_options(*app, options->scenes);
  app->add_option("--studies", options->studies, "some of them")
      ->delimiter(',')
      ->check(CLI::IsMember(list_words(kVolumeStudies)))
      ->capture_default_str();
  app->add_option("--turns", options->turn_count, "rays a receiver, in thousands (1024)")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  app->add_flag("--fit", options->fits, "find the curve of VolumeOptions::compensation over all these views");
  method::add_setting_option(*app, options->settings, method::device_setting());
  add_csv_option(*app, options->csv);
  return {app, [options] {
            VolumeStudies(*options).run();
            return 0;
          }};
}

}  // namespace lkao::bench
