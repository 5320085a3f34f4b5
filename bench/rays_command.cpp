// lkao-bench rays: lkao against every mode of Embree, on the same rays.
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "commands.h"
#include "csv_file.h"
#include "lkao/lkao.h"
#include "options.h"
#include "rays_cell.h"
#include "rays_report.h"
#include "study_scenes.h"
#include "tiles.h"

namespace lkao::bench {
namespace {

struct Options {
  StudySceneOptions scenes = {.views = {}, .names = {}, .width = 1024, .height = 768};
  std::vector<int> ray_counts = {128, 1024};
  MeasureOptions measure;
  int tile_count = 4;
  std::string isa;
  std::string csv;
};

// lkao is limited to one instruction set: by an option or by the environment.
bool is_limited(const Options& options) { return !options.isa.empty() || active_isa() != available_isas().front(); }

// What limits Embree to the instruction set that lkao is limited to. Nothing where lkao is not.
std::optional<std::string> embree_config(const Options& options) {
  const std::string isa = active_isa();
  if (!is_limited(options)) return std::nullopt;
  if (isa.starts_with("avx3") || isa.starts_with("avx10")) return "isa=avx512";
  if (isa == "avx2") return "isa=avx2";
  if (isa == "sse4") return "isa=sse4.2";
  if (isa == "ssse3" || isa == "sse2") return "isa=sse2";
  return std::nullopt;  // NEON and others: Embree has no choice there
}

class Comparison {
 public:
  explicit Comparison(const Options& options)
      : options_(options),
        names_(study_scene_names(options.scenes)),
        isas_(is_limited(options) ? std::vector{active_isa()} : available_isas()),
        config_(embree_config(options)),
        csv_(options.csv, rays_csv_heading()) {}

  void run() {
    if (options_.measure.thread_count > 1) fmt::print("{} threads\n", options_.measure.thread_count);
    fmt::print("{}", rays_table_heading());
    for (const std::string& name : names_) measure_scene(load_study_scene(name, options_.scenes));
    fmt::print("{}", rays_summary(cells_));
  }

 private:
  void measure_scene(const StudyScene& scene) {
    const std::vector<Receiver> receivers = choose_tiles(scene.view, options_.tile_count);
    if (receivers.empty()) throw std::runtime_error(scene.name + ": no tile of the picture is half full of receivers");
    const OccluderBvh occluders(scene.mesh.view());
    const reference::EmbreeScene rival(scene.mesh.view(), false, config_ ? config_->c_str() : nullptr);
    const reference::EmbreeReference oracle(scene.mesh, {});
    for (const float radius : scene.radii) {
      for (const int ray_count : options_.ray_counts) {
        Cell cell{scene.name, radius, ray_count, isas_, {}};
        measure({&occluders, &rival, &oracle, receivers}, options_.measure, cell);
        csv_.write(rays_csv_rows(cell));
        fmt::print("{}", rays_table_row(cell));
        std::fflush(stdout);
        cells_.push_back(std::move(cell));
      }
    }
  }

  Options options_;
  std::vector<std::string> names_;
  std::vector<std::string> isas_;
  std::optional<std::string> config_;
  CsvFile csv_;
  std::vector<Cell> cells_;
};

void check(const Options& options) {
  for (const int ray_count : options.ray_counts) {
    if (is_valid_ray_count(ray_count)) continue;
    throw std::invalid_argument(fmt::format("--samples must be multiples of {} from {} to {}, not {}", kRayCountStep,
                                            kMinRayCount, kMaxRayCount, ray_count));
  }
}

}  // namespace

Command add_rays_command(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* app = program.add_subcommand("rays", "Millions of rays a second, lkao against Embree.");
  add_scene_options(*app, options->scenes);
  app->add_option("--samples", options->ray_counts, "rays a receiver")->delimiter(',')->capture_default_str();
  add_rounds_option(*app, options->measure.round_count);
  app->add_option("--tiles", options->tile_count, "32 x 32 pixels each, of the view at 1024 x 768")
      ->check(CLI::Range(1, 768))
      ->capture_default_str();
  app->add_option("--threads", options->measure.thread_count, "of every method")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app->add_option(
      "--isa", options->isa,
      "instruction set of both: avx512, avx2, sse4, ... (default: the best, and the others for lkao alone)");
  add_csv_option(*app, options->csv);
  return {app, [options] {
            check(*options);
            if (!options->isa.empty()) force_isa(options->isa);
            Comparison(*options).run();
          }};
}

}  // namespace lkao::bench
