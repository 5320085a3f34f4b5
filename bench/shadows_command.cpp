// lkao-bench shadows: soft shadows of one light, lkao against every mode of Embree, on the same rays.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "bench/commands.h"
#include "bench/csv_file.h"
#include "bench/options.h"
#include "bench/shadows_cell.h"
#include "bench/study_scenes.h"
#include "bench/tiles.h"

namespace lkao::bench {
namespace {

struct ShadowsOptions {
  StudySceneOptions scenes = {.views = {}, .meshes = {}, .names = {}, .width = 1024, .height = 768};
  std::vector<int> ray_counts = {64, 128, 256, 512};
  std::vector<double> radii = {1, 4};  // of the light, percent of the scene's diagonal
  MeasureOptions measure;
  int tile_count = 4;
  std::vector<std::string> isas;
  std::string csv;
};

// Above the middle of the scene, nine tenths up; a disc faces down.
AreaLight hang_light(const StudyScene& scene, const std::string& kind, float radius) {
  const Bounds bounds = scene::bounds_of(scene.mesh);
  const glm::vec3 up = glm::normalize(scene.camera.up), half = 0.5f * (bounds.upper - bounds.lower);
  const glm::vec3 middle = bounds.lower + half;
  const glm::vec3 position = middle + up * (0.8f * glm::dot(half, glm::abs(up)));
  if (kind == "disc") return DiscLight{position, -up, radius};
  return SphereLight{position, radius};
}

Columns shadow_csv_columns() {
  return {{"scene"},
          {"light"},
          {"light_radius", "{:.6g}"},
          {"samples"},
          {"isa"},
          {"threads"},
          {"method"},
          {"mrays_per_second", "{:.6g}"},
          {"best_embree_mode"},
          {"best_embree_mrays", "{:.6g}"},
          {"ratio_best", "{:.5g}"},
          {"ray_mismatch_rate", "{:.4g}"},
          {"lit_share", "{:.4g}"},
          {"umbra_share", "{:.4g}"},
          {"visibility_mae", "{:.4g}"}};
}

Columns shadow_table_columns() {
  return {{"scene", "{}", -16},
          {"light", "{}", -6},
          {"light_radius", "{:.4g}", 8, "radius"},
          {"samples", "{}", 5, "rays"},
          {"isa", "{}", 8},
          {"threads", "{}", 3, "thr"},
          kBar,
          {"mrays_per_second", "{:.2f}", 8, "lkao"},
          {"single", "{:.2f}", 8},
          kBar,
          {"best_embree_mode", "{}", -28, "best of Embree"},
          {"best_embree_mrays", "{:.2f}", 8, "Mrays/s"},
          kBar,
          {"ratio_best", "{:.2f}", 6, "x best"},
          {"ratio_single", "{:.2f}", 8, "x single"},
          kBar,
          {"ray_mismatch_rate", "{:.2g}", 8, "mismatch"},
          {"lit_share", "{:.2f}", 5, "lit"},
          {"umbra_share", "{:.2f}", 5, "umbra"}};
}

Measurement measurement_of(const ShadowsCell& cell, const MethodResult& result) {
  const MethodResult& best = cell.best_embree();
  return {{"scene", cell.scene},
          {"light", cell.light},
          {"light_radius", cell.light_radius},
          {"samples", cell.ray_count},
          {"isa", cell.isa.name},
          {"threads", cell.thread_count},
          {"method", result.method},
          {"mrays_per_second", result.mrays_per_second},
          {"single", cell.single().mrays_per_second},
          {"best_embree_mode", best.method},
          {"best_embree_mrays", best.mrays_per_second},
          {"ratio_best", speed_ratio(result, best)},
          {"ratio_single", speed_ratio(cell.single(), best)},
          {"ray_mismatch_rate", result.mismatch_rate},
          {"lit_share", cell.lit_share},
          {"umbra_share", cell.umbra_share},
          {"visibility_mae", cell.mae}};
}

class ShadowsComparison {
 public:
  explicit ShadowsComparison(const ShadowsOptions& options)
      : options_(options),
        names_(study_scene_names(options.scenes)),
        isas_(compared_isas(options.isas)),
        csv_(options.csv, shadow_csv_columns(), {timing_remark(options.measure.round_count)}) {}

  void run() {
    fmt::print("{}", table_heading(columns_));
    for (const std::string& name : names_) measure_scene(load_study_scene(name, options_.scenes));
  }

 private:
  void measure_scene(const StudyScene& scene) {
    const std::vector<Receiver> receivers = choose_tiles(scene, options_.tile_count);
    const OccluderBvh occluders(scene.mesh.view());
    const reference::EmbreeReference oracle(scene.mesh, {});
    for (const ComparedIsa& isa : isas_) {
      const char* const config = isa.embree_config.empty() ? nullptr : isa.embree_config.c_str();
      const reference::EmbreeScene rival(scene.mesh.view(), false, config);
      measure_lights({&occluders, &rival, &oracle, receivers}, scene, isa);
    }
  }

  void measure_lights(const CellInput& input, const StudyScene& scene, const ComparedIsa& isa) {
    const Bounds bounds = scene::bounds_of(scene.mesh);
    for (const std::string kind : {"disc", "sphere"}) {
      for (const double percent : options_.radii) {
        const float radius = static_cast<float>(percent) / 100 * glm::distance(bounds.lower, bounds.upper);
        const AreaLight light = hang_light(scene, kind, radius);
        for (const int ray_count : options_.ray_counts) {
          add(measure_shadows(input, light, options_.measure, {scene.name, kind, radius, ray_count, isa}));
        }
      }
    }
  }

  void add(const std::vector<ShadowsCell>& cells) {
    for (const ShadowsCell& cell : cells) {
      for (const MethodResult& result : cell.results) csv_.write(measurement_of(cell, result));
      fmt::print("{}", table_row(columns_, measurement_of(cell, cell.batch())));
    }
    std::fflush(stdout);
  }

  ShadowsOptions options_;
  std::vector<std::string> names_;
  std::vector<ComparedIsa> isas_;
  CsvFile csv_;
  const Columns columns_ = shadow_table_columns();
};

void check(const ShadowsOptions& options) {
  check_ray_counts(options.ray_counts);
  for (const double percent : options.radii) {
    if (percent > 0 && percent <= 100) continue;
    throw std::invalid_argument(fmt::format("--light-radius must be above 0 and at most 100, not {:g}", percent));
  }
}

}  // namespace

Command add_shadows_command(CLI::App& program) {
  auto options = std::make_shared<ShadowsOptions>();
  CLI::App* app = program.add_subcommand(
      "shadows",
      "Soft shadows of a disc and a sphere that hang in the scene, lkao against Embree. One thread: by its CPU time; "
      "several: by wall time.");
  add_scene_options(*app, options->scenes);
  app->add_option("--light-radius", options->radii, "radii of the light, percent of the scene's diagonal")
      ->delimiter(',')
      ->capture_default_str();
  add_ray_counts_option(*app, options->ray_counts);
  add_rounds_option(*app, options->measure.round_count);
  add_tiles_option(*app, options->tile_count);
  add_threads_option(*app, options->measure.thread_counts);
  add_isas_option(*app, options->isas);
  add_csv_option(*app, options->csv);
  return {app, [options] {
            check(*options);
            ShadowsComparison(*options).run();
            return 0;
          }};
}

}  // namespace lkao::bench
