// lkao-bench screen: methods in screen space. What their assumptions cost against rays, and what their few samples cost
// against those same assumptions.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
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

struct ScreenVariant {
  std::string name;
  ChangedSettings settings;
  int sample_count = 0;  // of a curve against samples
};

// A method, and how its curve against samples is made: one setting varies, beside these.
struct ScreenKind {
  const char* method;
  ChangedSettings curve;
  const char* samples;  // the setting
  std::vector<int> counts;
  int samples_each = 1;  // samples a pixel by one of them
};

const std::vector<ScreenKind>& screen_kinds() {
  static const std::vector<ScreenKind> kinds = {
      {"alchemy", {{"alchemy-bands", "1"}}, "alchemy-samples", {1, 2, 4, 8, 16, 32, 64, 128, 256}},
      {"vao", {{"vao-fewest-width", "0"}, {"vao-culling", "off"}}, "vao-samples", {2, 4, 8, 16, 32}},
      {"gtao", {{"slice-steps", "32"}}, "slices", {1, 2, 4, 8, 16, 32, 64}, 64},
      {"vbao", {{"slice-steps", "32"}}, "slices", {1, 2, 4, 8, 16, 32, 64}, 64}};
  return kinds;
}

const ChangedSettings kConverged = {{"converged", "on"}};

std::vector<ScreenVariant> error_variants(const ScreenKind& kind) {
  std::vector<ScreenVariant> variants = {{"default", {}},
                                         {"no filter", {{"filter", "0"}}},
                                         {"every second pixel", {{"step", "2"}}},
                                         {"converged; guard band", {{"converged", "on"}, {"guard-band", "64"}}}};
  // Alchemy's picture is cut off at black: a smaller intensity is more than a factor.
  if (std::string_view(kind.method) == "alchemy") {
    variants.push_back({"intensity 0.8", {{"alchemy-intensity", "0.8"}}});
    variants.push_back({"converged; intensity 0.8", {{"converged", "on"}, {"alchemy-intensity", "0.8"}}});
  }
  if (std::string_view(kind.method) == "vao") {
    for (const char* culling : {"off", "careful", "greedy"}) {
      variants.push_back({fmt::format("culling {}", culling), {{"vao-culling", culling}}});
    }
  }
  return variants;
}

std::vector<ScreenVariant> sample_variants(const ScreenKind& kind) {
  std::vector<ScreenVariant> variants;
  for (const int count : kind.counts) {
    ScreenVariant variant{fmt::format("{} {}", kind.samples, count), kind.curve, count * kind.samples_each};
    variant.settings.emplace_back(kind.samples, std::to_string(count));
    variant.settings.emplace_back("filter", "0");
    variants.push_back(variant);
  }
  return variants;
}

Columns screen_csv_columns() {
  return {{"scene"},
          {"radius", "{:.6g}"},
          {"method"},
          {"study"},
          {"variant"},
          {"samples"},
          {"milliseconds", "{:.5g}"},
          {"culled_share", "{:.4g}"},
          {"mean_of_rays", "{:.4g}"},
          {"mean_change", "{:.4g}"},
          {"mae", "{:.4g}"},
          {"rmse", "{:.4g}"},
          {"best_factor", "{:.4g}"},
          {"best_rmse", "{:.4g}"},
          {"estimator_mean_change", "{:.4g}"},
          {"estimator_rmse", "{:.4g}"},
          {"slope", "{:.3g}"}};
}

Columns screen_table_columns() {
  return {{"scene", "{}", -12},
          {"radius", "{:.4g}", 7},
          {"method", "{}", -8},
          {"variant", "{}", -22},
          kBar,
          {"milliseconds", "{:.1f}", 8, "ms"},
          {"culled_share", "{:.2f}", 6, "culled"},
          kBar,
          {"mean_of_rays", "{:.4f}", 7, "rays"},
          {"mean_change", "{:+.4f}", 8, "change"},
          {"rmse", "{:.4f}", 7, "RMSE"},
          {"best_factor", "{:.2f}", 5, "x"},
          {"best_rmse", "{:.4f}", 7, "RMSE"},
          kBar,
          {"estimator_mean_change", "{:+.4f}", 8, "change"},
          {"estimator_rmse", "{:.4f}", 8, "RMSE"},
          {"slope", "{:.2f}", 6}};
}

struct ScreenOptions {
  StudySceneOptions scenes = {.views = {}, .meshes = {}, .names = {}, .width = 512, .height = 384};
  method::Settings settings;          // the device
  std::vector<method::Radius> radii;  // empty: the scene's own
  std::vector<std::string> methods;   // empty: all
  std::vector<std::string> studies = {"errors", "samples"};
  std::string csv;
};

std::vector<std::string> screen_words() {
  std::vector<std::string> words;
  for (const ScreenKind& kind : screen_kinds()) words.emplace_back(kind.method);
  return words;
}

class ScreenStudy {
 public:
  explicit ScreenStudy(const ScreenOptions& options)
      : options_(options),
        names_(study_scene_names(options.scenes)),
        csv_(options.csv, screen_csv_columns(),
             device_notes(method::method_named("alchemy").open(options.settings)->device())) {}

  void run() {
    fmt::print("{} x {} pixels; first against {} rays, then against the method's own assumptions\n{}",
               options_.scenes.width, options_.scenes.height, kMaxRayCount, table_heading(columns_));
    for (const std::string& name : names_) {
      const StudyScene scene = load_study_scene(name, options_.scenes);
      for (const float radius : options_.radii.empty() ? scene.radii : lengths_of(options_.radii, scene)) {
        const std::vector<float> rays = cast_rays(scene, radius, Falloff::constant(), 1);
        for (const ScreenKind& kind : screen_kinds()) {
          if (is_wanted(options_.methods, kind.method)) study(scene, radius, rays, kind);
        }
      }
    }
  }

 private:
  static bool is_wanted(const std::vector<std::string>& words, const std::string& word) {
    return words.empty() || std::find(words.begin(), words.end(), word) != words.end();
  }

  void study(const StudyScene& scene, float radius, const std::vector<float>& rays, const ScreenKind& kind) {
    const auto draw = [&](const ChangedSettings& changed) {
      return draw_method(kind.method, scene, radius, Falloff::constant(),
                         settings_of(kind.method, changed, options_.settings), rays);
    };
    const DrawnResult converged = draw(kConverged);
    Row row{scene, radius, kind, rays, converged.occlusion};
    if (is_wanted(options_.studies, "errors")) {
      report(row, "errors", {"converged", kConverged}, converged);
      for (const ScreenVariant& variant : error_variants(kind)) report(row, "errors", variant, draw(variant.settings));
    }
    if (is_wanted(options_.studies, "samples")) {
      for (const ScreenVariant& variant : sample_variants(kind)) {
        report(row, "samples", variant, draw(variant.settings));
      }
    }
  }

  // What all rows of one method share, and the last one's point of the curve against samples.
  struct Row {
    const StudyScene& scene;
    float radius;
    const ScreenKind& kind;
    const std::vector<float>& rays;
    const std::vector<float>& converged;
    int last_sample_count = 0;
    double last_rmse = 0;
  };

  // Of log RMSE against the log of samples, from the last row.
  static std::optional<double> slope(Row& row, int sample_count, double rmse) {
    std::optional<double> result;
    if (sample_count > 0 && row.last_sample_count > 0 && rmse > 0 && row.last_rmse > 0) {
      result = std::log(rmse / row.last_rmse) / std::log(double(sample_count) / row.last_sample_count);
    }
    row.last_sample_count = sample_count;
    row.last_rmse = rmse;
    return result;
  }

  void report(Row& row, const char* study, const ScreenVariant& variant, const DrawnResult& drawn) {
    const method::Deviation own = method::deviation(drawn.occlusion, row.converged, std::nullopt, 0);
    const double factor = best_factor(drawn.occlusion, row.rays);
    Value culled, samples;
    if (drawn.keys.contains("culled_share")) culled = Value(drawn.keys.at("culled_share").get<double>());
    if (variant.sample_count > 0) samples = Value(variant.sample_count);
    const Measurement measurement = {{"scene", row.scene.name},
                                     {"radius", row.radius},
                                     {"method", row.kind.method},
                                     {"study", study},
                                     {"variant", variant.name},
                                     {"samples", samples},
                                     {"milliseconds", drawn.milliseconds},
                                     {"culled_share", culled},
                                     {"mean_of_rays", mean_of(row.rays)},
                                     {"mean_change", drawn.off.mean_change},
                                     {"mae", drawn.off.error.mae},
                                     {"rmse", drawn.off.error.rmse},
                                     {"best_factor", factor},
                                     {"best_rmse", scaled_rmse(drawn.occlusion, row.rays, factor)},
                                     {"estimator_mean_change", own.mean_change},
                                     {"estimator_rmse", own.error.rmse},
                                     {"slope", slope(row, variant.sample_count, own.error.rmse)}};
    csv_.write(measurement);
    fmt::print("{}", table_row(columns_, measurement));
    std::fflush(stdout);
  }

  ScreenOptions options_;
  std::vector<std::string> names_;
  CsvFile csv_;
  const Columns columns_ = screen_table_columns();
};

}  // namespace

Command add_screen_command(CLI::App& program) {
  auto options = std::make_shared<ScreenOptions>();
  CLI::App* app = program.add_subcommand(
      "screen", "Methods in screen space: errors against rays, and of few samples against many of their own.");
  add_scene_options(*app, options->scenes);
  add_radii_option(*app, "--radii", options->radii,
                   "AO radii: lengths or 5% of the scene's diagonal (default: each scene's own)");
  add_size_options(*app, options->scenes);
  app->add_option("--methods", options->methods, "some of them")->delimiter(',')->check(CLI::IsMember(screen_words()));
  app->add_option("--studies", options->studies, "some of them")
      ->delimiter(',')
      ->check(CLI::IsMember({"errors", "samples"}))
      ->capture_default_str();
  method::add_setting_option(*app, options->settings, method::device_setting());
  add_csv_option(*app, options->csv);
  return {app, [options] {
            ScreenStudy(*options).run();
            return 0;
          }};
}

}  // namespace lkao::bench
