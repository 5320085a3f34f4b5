// lkao-bench patterns: how far sample patterns are from the integral: kinds, ray counts, falloffs, and how they are
// turned.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "bench/commands.h"
#include "bench/csv_file.h"
#include "bench/options.h"
#include "bench/pattern_cases.h"
#include "bench/pattern_errors.h"
#include "bench/pattern_image.h"
#include "bench/pattern_report.h"
#include "bench/study_scenes.h"
#include "image/image.h"

namespace lkao::bench {
namespace {

struct PatternsOptions {
  StudySceneOptions scenes;
  PatternStudyOptions study;
  int receiver_count = 2048;
  std::string csv;
  std::string image;
  std::string image_scene = "atrium";
};

// Without --views and --scenes.
const std::vector<std::string> kBuiltIn = {"atrium", "city", "hairball", "wall", "sphere"};

// Neighbouring pixels two by two, evenly over the picture.
std::vector<Receiver> choose_pairs(const std::vector<Receiver>& pixels, int receiver_count) {
  const std::size_t pair_count = std::min(pixels.size(), static_cast<std::size_t>(receiver_count)) / 2;
  std::vector<Receiver> chosen;
  for (std::size_t pair = 0; pair < pair_count; ++pair) {
    const std::size_t first = pair * (pixels.size() - 1) / pair_count;
    chosen.push_back(pixels[first]);
    chosen.push_back(pixels[first + 1]);
  }
  return chosen;
}

// Writes each scene's errors as they come.
std::vector<PatternRow> measure(const PatternsOptions& options) {
  CsvFile csv(options.csv, patterns_csv_columns());
  std::vector<PatternRow> rows;
  const std::vector<PatternCase> cases = study_cases();
  for (const StudyScene& scene : load_study_scenes(options.scenes)) {
    const std::vector<Receiver> receivers = choose_pairs(scene.receivers, options.receiver_count);
    fmt::print(stderr, "{}: {} receivers, radius {}\n", scene.name, receivers.size(), scene.radii.back());
    for (const PatternError& error :
         measure_pattern_errors(scene.mesh, scene.radii.back(), receivers, cases, options.study)) {
      rows.push_back({scene.name, error});
      csv.write(pattern_measurement(rows.back()));
    }
  }
  return rows;
}

void run(PatternsOptions& options) {
  if (!options.image.empty()) return image::write_image(options.image, pattern_image(options.image_scene));
  if (options.scenes.views.empty() && options.scenes.names.empty()) options.scenes.names = kBuiltIn;
  print_pattern_tables(measure(options));
}

}  // namespace

Command add_patterns_command(CLI::App& program) {
  auto options = std::make_shared<PatternsOptions>();
  options->scenes.width = 1024;
  options->scenes.height = 768;
  CLI::App* app =
      program.add_subcommand("patterns", "Errors of sample patterns against the integral with closest hits.");
  add_scene_options(*app, options->scenes, fmt::format("{}", fmt::join(kBuiltIn, ", ")));
  app->add_option("--receivers", options->receiver_count, "receivers a scene")->check(CLI::Range(2, 1 << 20));
  app->add_option("--reference-rays", options->study.reference_ray_count)->check(CLI::Range(64, 1 << 20));
  app->add_option("--seeds", options->study.seed_count, "patterns of each kind")->check(CLI::Range(1, 100));
  add_csv_option(*app, options->csv);
  app->add_option("--image", options->image, "only write a picture of every pattern at work (.png, .exr)");
  app->add_option("--image-scene", options->image_scene, "built-in scene of the picture");
  return {app, [options] {
            run(*options);
            return 0;
          }};
}

}  // namespace lkao::bench
