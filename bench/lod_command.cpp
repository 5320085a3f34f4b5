// lkao-bench lod: what levels of detail save, and what they cost. Figure 7 of Laine & Karras 2010 in numbers.
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "bench/commands.h"
#include "bench/csv_file.h"
#include "bench/lod_variants.h"
#include "bench/options.h"
#include "bench/study_scenes.h"
#include "method/answers.h"
#include "method/list.h"
#include "method/setting_options.h"
#include "method/stopwatch.h"

namespace lkao::bench {
namespace {

struct LodOptions {
  StudySceneOptions scenes = {.views = {}, .meshes = {}, .names = {}, .width = 192, .height = 144};
  std::vector<std::string> methods;  // the traversal first: it says what is exact
  method::Settings settings;
  std::vector<float> ks = {2, 3, 5, 10};
  int level_count = 4;
  int round_count = 1;
  std::string csv;
};

std::vector<const method::MethodKind*> kinds_with_levels() {
  std::vector<const method::MethodKind*> kinds;
  for (const method::MethodKind& kind : method::method_kinds()) {
    if (kind.is_built() && kind.abilities({}).levels) kinds.push_back(&kind);
  }
  return kinds;
}

Columns csv_columns() {
  return {{"scene"},
          {"radius", "{:g}"},
          {"method"},
          {"k", "{:g}"},
          {"epsilon", "{:g}"},
          {"triangles"},
          {"milliseconds", "{:.5g}"},
          {"speedup", "{:.4f}"},
          {"ray_mismatch_rate", "{:.4g}"},
          {"mae", "{:.4g}"},
          {"rmse", "{:.4g}"},
          {"equal_8bit_share", "{:.5f}"},
          {"mean_change", "{:.4g}"}};
}

Columns table_columns() {
  return {{"scene", "{}", -14},
          {"radius", "{:g}", 7},
          {"method", "{}", -6},
          {"k", "{:g}", 3},
          {"epsilon", "{:.3g}", 9},
          {"triangles", "{}", 10},
          kBar,
          {"milliseconds", "{:.2f}", 9, "ms"},
          {"speedup", "{:.2f}", 6, "x"},
          kBar,
          {"ray_mismatch_rate", "{:.2g}", 9, "mismatch"},
          {"mae", "{:.5f}", 8, "MAE"},
          {"rmse", "{:.5f}", 8, "RMSE"},
          {"equal_8bit_percent", "{:.2f}%", 7, "8 bits"},
          {"mean_change", "{:+.5f}", 8, "change"}};
}

struct OpenMethod {
  std::string word;
  std::unique_ptr<method::Method> method;
};

std::vector<OpenMethod> open_methods(const LodOptions& options) {
  std::vector<OpenMethod> methods;
  for (const std::string& word : options.methods) {
    methods.push_back({word, method::method_named(word).open(options.settings)});
  }
  return methods;
}

std::string devices_of(const std::vector<OpenMethod>& methods) {
  std::string devices;
  for (const OpenMethod& open : methods) devices += open.method->device();
  return devices;
}

class Studies {
 public:
  explicit Studies(const LodOptions& options)
      : options_(options),
        names_(study_scene_names(options.scenes)),
        methods_(open_methods(options)),
        csv_(options.csv, csv_columns(), device_notes(devices_of(methods_))) {}

  void run() {
    fmt::print("{}", table_heading(columns_));
    for (const std::string& name : names_) study_scene(load_study_scene(name, options_.scenes));
  }

 private:
  // At its large radius.
  void study_scene(const StudyScene& scene) {
    const method::Stopwatch time;
    const std::vector<LodVariant> variants =
        make_lod_variants(scene.mesh, scene.radii.back(), options_.level_count, options_.ks);
    const double simplify_seconds = time.seconds();
    std::optional<method::Answers> exact;
    for (const OpenMethod& open : methods_) study_method(scene, variants, open, exact);
    fmt::print("{:14} simplified in {:.1f} s\n", scene.name, simplify_seconds);
    std::fflush(stdout);
  }

  // The first answers ever, of the scene itself, are the exact ones.
  void study_method(const StudyScene& scene, const std::vector<LodVariant>& variants, const OpenMethod& open,
                    std::optional<method::Answers>& exact) {
    double scene_seconds = 0;
    for (const LodVariant& variant : variants) {
      const method::Answers answers = answer(scene, variant, *open.method);
      if (!exact) exact = answers;
      if (&variant == &variants.front()) scene_seconds = answers.seconds;
      report(scene, variant, open.word, answers, scene_seconds, deviation(answers, *exact));
    }
  }

  method::Answers answer(const StudyScene& scene, const LodVariant& variant, method::Method& method) const {
    const method::Question question{.radius = scene.radii.back()};
    method::Occluders occluders(scene.mesh, variant.chain, question.radius);
    method.prepare({occluders, question, method::View{scene.camera, scene.view}});
    return method::ask(method, question.pattern().word_count(), scene.view.receivers, options_.round_count);
  }

  void report(const StudyScene& scene, const LodVariant& variant, const std::string& word,
              const method::Answers& answers, double scene_seconds, const method::Deviation& off) {
    const Measurement measurement = {{"scene", scene.name},
                                     {"radius", scene.radii.back()},
                                     {"method", word},
                                     {"k", variant.k},
                                     {"epsilon", variant.epsilon},
                                     {"triangles", triangle_count(variant, scene.radii.back())},
                                     {"milliseconds", 1000 * answers.seconds},
                                     {"speedup", scene_seconds / answers.seconds},
                                     {"ray_mismatch_rate", off.mismatch_rate},
                                     {"mae", off.error.mae},
                                     {"rmse", off.error.rmse},
                                     {"equal_8bit_share", off.error.equal_8bit_share},
                                     {"equal_8bit_percent", 100 * off.error.equal_8bit_share},
                                     {"mean_change", off.mean_change}};
    csv_.write(measurement);
    fmt::print("{}", table_row(columns_, measurement));
    std::fflush(stdout);
  }

  LodOptions options_;
  std::vector<std::string> names_;
  std::vector<OpenMethod> methods_;
  CsvFile csv_;
  const Columns columns_ = table_columns();
};

}  // namespace

Command add_lod_command(CLI::App& program) {
  auto options = std::make_shared<LodOptions>();
  const std::vector<const method::MethodKind*> kinds = kinds_with_levels();
  for (const method::MethodKind* kind : kinds) options->methods.emplace_back(kind->word);
  CLI::App* app = program.add_subcommand("lod", "Levels of detail: time saved and error added, at the large radius.");
  add_scene_options(*app, options->scenes);
  add_size_options(*app, options->scenes);
  app->add_option("--k", options->ks, "how many times its error a level stays away")
      ->delimiter(',')
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app->add_option("--levels", options->level_count, "with the original")
      ->check(CLI::Range(2, 8))
      ->capture_default_str();
  app->add_option("--methods", options->methods, "the first one says what is exact")
      ->delimiter(',')
      ->check(CLI::IsMember(options->methods))
      ->capture_default_str();
  method::add_setting_options(*app, options->settings, kinds);
  add_rounds_option(*app, options->round_count);
  add_csv_option(*app, options->csv);
  return {app, [options] {
            Studies(*options).run();
            return 0;
          }};
}

}  // namespace lkao::bench
