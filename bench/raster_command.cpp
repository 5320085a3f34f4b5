// lkao-bench raster: the rasterised method, its time and its errors against the CPU's exact query.
#include <cstdio>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "bench/commands.h"
#include "bench/csv_file.h"
#include "bench/options.h"
#include "bench/radii.h"
#include "bench/raster_frames.h"
#include "bench/raster_report.h"
#include "bench/study_scenes.h"
#include "method/gl_device.h"
#include "method/setting_options.h"

namespace lkao::bench {
namespace {

std::vector<FrameSetup> methods() {
  return {{.name = "nearest cells", .masks = PlaneMasks::nearest},
          {.name = "exact", .masks = PlaneMasks::must_may},
          {.name = "exact in double",
           .masks = PlaneMasks::must_may,
           .pass = {.precision = gl::Precision::double_precision}}};
}

// The paper's alpha, from prisms only to billboards only; 0.2 comes last, to be compared with.
std::vector<FrameSetup> shapes() {
  std::vector<FrameSetup> setups;
  for (const float alpha : {0.0f, 0.05f, 0.1f, 0.4f, 0.8f, std::numeric_limits<float>::infinity(), 0.2f}) {
    const char* note = alpha == 0 ? " (prisms)" : alpha > 1 ? " (billboards)" : "";
    setups.push_back({.name = fmt::format("alpha {:g}{}", alpha, note), .raster = {.billboard_threshold = alpha}});
  }
  return setups;
}

std::vector<FrameSetup> back_ends() {
  std::vector<FrameSetup> setups;
  for (const auto& [geometry_word, geometry] : method::kGeometryWords) {
    for (const auto& [accumulator_word, accumulator] : method::kAccumulatorWords) {
      setups.push_back({.name = fmt::format("{} + {}", geometry_word, accumulator_word),
                        .pass = {.geometry = geometry, .accumulator = accumulator}});
    }
  }
  return setups;
}

constexpr method::Word<std::vector<FrameSetup> (*)()> kStudies[] = {
    {"methods", methods}, {"culls", cull_setups}, {"shapes", shapes}, {"back_ends", back_ends}};

struct RasterOptions {
  StudySceneOptions scenes = {.views = {}, .meshes = {}, .names = {}, .width = 512, .height = 384};
  FrameOptions frames;
  method::Settings settings;          // the device
  std::vector<method::Radius> radii;  // empty: the scene's own
  std::vector<std::string> studies = list_words(kStudies);
  std::string csv;
};

class RasterStudies {
 public:
  explicit RasterStudies(const RasterOptions& options)
      : options_(options),
        names_(study_scene_names(options.scenes)),
        rasterizer_(method::prepare_device(options.settings)),
        csv_(options.csv, raster_csv_columns(), device_notes(device())) {}

  void run() {
    fmt::print("{}, {} x {} pixels, {} rays\n{}", device(), options_.scenes.width, options_.scenes.height,
               options_.frames.ray_count, table_heading(columns_));
    for (const std::string& name : names_) study_scene(load_study_scene(name, options_.scenes));
  }

 private:
  std::string device() const { return method::device_text(rasterizer_.context()); }

  void study_scene(const StudyScene& scene) {
    for (const float radius : options_.radii.empty() ? scene.radii : lengths_of(options_.radii, scene)) {
      RasterFrames frames(rasterizer_, scene, radius, options_.frames);
      for (const std::string& study : options_.studies) report(run_study(frames, {scene.name, radius, study, {}, {}}));
    }
  }

  static RasterStudy run_study(RasterFrames& frames, RasterStudy study) {
    const std::vector<FrameSetup> setups = parse_word(kStudies, study.name)();
    for (const FrameSetup& setup : setups) study.variants.push_back(setup.name);
    study.results = frames.draw(setups, study.name == "culls" || study.name == "shapes");
    if (study.name == "methods") {
      study.variants.push_back("the query on the CPU");
      study.results.push_back(frames.query());
    }
    return study;
  }

  void report(const RasterStudy& study) {
    for (const Measurement& measurement : raster_measurements(study)) {
      csv_.write(measurement);
      fmt::print("{}", table_row(columns_, measurement));
    }
    std::fflush(stdout);
  }

  RasterOptions options_;
  std::vector<std::string> names_;
  raster::Rasterizer rasterizer_;
  CsvFile csv_;
  const Columns columns_ = raster_table_columns();
};

void check(const RasterOptions& options) {
  if (!is_valid_ray_count(options.frames.ray_count)) {
    throw std::invalid_argument(
        fmt::format("--samples must be from {} to {}, not {}", kMinRayCount, kMaxRayCount, options.frames.ray_count));
  }
}

}  // namespace

Command add_raster_command(CLI::App& program) {
  auto options = std::make_shared<RasterOptions>();
  CLI::App* app = program.add_subcommand("raster", "The rasterised method: time and errors against the CPU's query.");
  add_scene_options(*app, options->scenes);
  add_radii_option(*app, "--radii", options->radii,
                   "AO radii: lengths, 5% of the scene's diagonal, or inf (default: each scene's own)");
  add_size_options(*app, options->scenes);
  app->add_option("--samples", options->frames.ray_count, "rays a receiver")->capture_default_str();
  app->add_option("--studies", options->studies, "some of them")
      ->delimiter(',')
      ->check(CLI::IsMember(list_words(kStudies)))
      ->capture_default_str();
  add_rounds_option(*app, options->frames.round_count);
  method::add_setting_option(*app, options->settings, method::device_setting());
  add_csv_option(*app, options->csv);
  return {app, [options] {
            check(*options);
            RasterStudies(*options).run();
            return 0;
          }};
}

}  // namespace lkao::bench
