// lkao-bench lod: what levels of detail save, and what they cost. Figure 7 of Laine & Karras 2010 in numbers.
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "answers.h"
#include "cli/stopwatch.h"
#include "commands.h"
#include "csv_file.h"
#include "lod/occluders.h"
#include "lod/simplify.h"
#include "options.h"
#include "raster_frames.h"
#include "study_scenes.h"

namespace lkao::bench {
namespace {

struct Options {
  StudySceneOptions scenes = {.views = {}, .meshes = {}, .names = {}, .width = 192, .height = 144};
  FrameOptions frames;
  std::vector<float> ks = {2, 3, 5, 10};
  int level_count = 4;
  bool without_raster = false;
  std::string csv;
};

// Levels for one k and one epsilon.
struct Variant {
  float k = 0, epsilon = 0;  // 0: the scene itself
  lod::Chain chain;
};

// What one method makes of a variant.
struct Row {
  const char* method;
  double milliseconds;
  Deviation off;
};

// Levels of detail of one scene at its large radius, by both methods.
class LodStudy {
 public:
  LodStudy(const StudyScene& scene, const Options& options) : scene_(scene), options_(options) {}

  void prepare() {
    const cli::Stopwatch time;
    // A third of the automatic epsilon, and one level more: the chain without its first level is the automatic one.
    lod::LevelRule rule{.epsilon = 0, .level_count = options_.level_count};
    rule.epsilon = lod::automatic_epsilon(radius(), rule) / rule.growth;
    ++rule.level_count;
    const lod::Chain chain = lod::simplify(scene_.mesh, {.levels = rule}).chain;
    simplify_seconds_ = time.seconds();
    variants_.push_back({0, 0, {.k = 0, .growth = 0, .levels = {{scene_.mesh, 0, 0, kInfinity}}}});
    for (const std::size_t skipped : {std::size_t{0}, std::size_t{1}}) {
      for (const float k : options_.ks) variants_.push_back(variant_of(chain, skipped, k));
    }
  }

  float radius() const { return scene_.radii.back(); }
  double simplify_seconds() const { return simplify_seconds_; }
  const std::vector<Variant>& variants() const { return variants_; }

  std::vector<Row> by_query() {
    const SamplePattern& pattern = SamplePattern::standard(options_.frames.ray_count);
    std::vector<AmbientOcclusion> queries;
    for (const Variant& variant : variants_) {
      queries.emplace_back(lod::build_levels(variant.chain, radius()), pattern, RayOptions{.radius = radius()});
    }
    const std::vector<Answers> answers = ask(queries, scene_.view.receivers, options_.frames.round_count);
    exact_ = answers[0];
    std::vector<Row> rows;
    for (const Answers& a : answers) rows.push_back({"bvh", 1000 * a.seconds, deviation(a, exact_)});
    return rows;
  }

  // After by_query(), which tells what is exact.
  std::vector<Row> by_raster(raster::Rasterizer& rasterizer) const {
    RasterFrames frames(rasterizer, scene_, radius(), options_.frames);
    frames.set_exact(Sidedness::two_sided, exact_);
    std::vector<Row> rows;
    for (const Variant& variant : variants_) {
      const lod::RangedMesh merged = lod::merge(variant.chain, radius());
      const FrameSetup setup{.name = "", .masks = PlaneMasks::must_may, .levels = &merged};
      const FrameResult result = frames.draw({setup}, false).front();
      rows.push_back({"raster", result.milliseconds, result.off});
    }
    return rows;
  }

 private:
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();

  // Without the first `skipped` simplified levels, and ranges for another k.
  static Variant variant_of(const lod::Chain& chain, std::size_t skipped, float k) {
    const auto first = chain.levels.begin() + 1 + static_cast<std::ptrdiff_t>(skipped);
    const int level_count = 1 + static_cast<int>(chain.levels.end() - first);
    Variant variant{k, first->epsilon, lod::empty_chain({first->epsilon, k, chain.growth, level_count})};
    variant.chain.levels[0].mesh = chain.levels[0].mesh;
    for (std::size_t i = 1; i < variant.chain.levels.size(); ++i) {
      variant.chain.levels[i].mesh = chain.levels[i + skipped].mesh;
    }
    return variant;
  }

  const StudyScene& scene_;
  const Options& options_;
  double simplify_seconds_ = 0;
  std::vector<Variant> variants_;
  Answers exact_;  // for the scene itself
};

class Studies {
 public:
  explicit Studies(const Options& options)
      : options_(options),
        names_(study_scene_names(options.scenes)),
        csv_(options.csv,
             "scene,radius,method,k,epsilon,triangles,milliseconds,speedup,ray_mismatch_rate,mae,rmse,equal_8bit_share,"
             "mean_change\n") {
    if (!options.without_raster) rasterizer_.emplace(options.frames.device);
  }

  void run() {
    fmt::print("{:14} {:>7} {:6} {:>3} {:>9} {:>10} | {:>9} {:>6} | {:>9} {:>8} {:>8} {:>7} {:>8}\n", "scene", "radius",
               "method", "k", "epsilon", "triangles", "ms", "x", "mismatch", "MAE", "RMSE", "8 bits", "change");
    for (const std::string& name : names_) study_scene(load_study_scene(name, options_.scenes));
  }

 private:
  void study_scene(const StudyScene& scene) {
    LodStudy study(scene, options_);
    study.prepare();
    report(scene, study, study.by_query());
    if (rasterizer_) report(scene, study, study.by_raster(*rasterizer_));
    fmt::print("{:14} simplified in {:.1f} s\n", scene.name, study.simplify_seconds());
    std::fflush(stdout);
  }

  void report(const StudyScene& scene, const LodStudy& study, const std::vector<Row>& rows) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Variant& variant = study.variants()[i];
      std::size_t triangle_count = 0;
      for (const lod::LevelInUse& level : lod::levels_in_use(variant.chain, study.radius())) {
        triangle_count += level.mesh->triangles.size();
      }
      const Row& row = rows[i];
      const double speedup = rows[0].milliseconds / row.milliseconds;
      fmt::print("{:14} {:7g} {:6} {:3g} {:9.3g} {:10} | {:9.2f} {:6.2f} | {:9.2g} {:8.5f} {:8.5f} {:6.2f}% {:+8.5f}\n",
                 scene.name, study.radius(), row.method, variant.k, variant.epsilon, triangle_count, row.milliseconds,
                 speedup, row.off.mismatch_rate, row.off.error.mae, row.off.error.rmse,
                 100 * row.off.error.equal_8bit_share, row.off.mean_change);
      csv_.write(fmt::format("{},{:g},{},{:g},{:g},{},{:.5g},{:.4f},{:.4g},{:.4g},{:.4g},{:.5f},{:.4g}\n", scene.name,
                             study.radius(), row.method, variant.k, variant.epsilon, triangle_count, row.milliseconds,
                             speedup, row.off.mismatch_rate, row.off.error.mae, row.off.error.rmse,
                             row.off.error.equal_8bit_share, row.off.mean_change));
    }
    std::fflush(stdout);
  }

  Options options_;
  std::vector<std::string> names_;
  CsvFile csv_;
  std::optional<raster::Rasterizer> rasterizer_;
};

}  // namespace

Command add_lod_command(CLI::App& program) {
  auto options = std::make_shared<Options>();
  options->frames.round_count = 1;
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
  add_rounds_option(*app, options->frames.round_count);
  add_gl_option(*app, options->frames.device);
  app->add_flag("--without-raster", options->without_raster, "the query alone");
  add_csv_option(*app, options->csv);
  return {app, [options] { Studies(*options).run(); }};
}

}  // namespace lkao::bench
