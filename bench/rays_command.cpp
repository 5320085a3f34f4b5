// lkao-bench rays: lkao against every mode of Embree, on the same rays.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "bench/commands.h"
#include "bench/compared_isas.h"
#include "bench/csv_file.h"
#include "bench/options.h"
#include "bench/radii.h"
#include "bench/rays_cell.h"
#include "bench/rays_csv.h"
#include "bench/rays_radii.h"
#include "bench/rays_report.h"
#include "bench/study_scenes.h"
#include "bench/tiles.h"
#include "lkao/lkao.h"

namespace lkao::bench {
namespace {

struct RaysOptions {
  StudySceneOptions scenes = {.views = {}, .meshes = {}, .names = {}, .width = 1024, .height = 768};
  std::vector<method::Radius> radii;  // empty: compared_radii
  std::vector<int> ray_counts = {128, 1024};
  MeasureOptions measure;
  int tile_count = 4;
  std::vector<std::string> isas;
  std::string csv;
};

class RaysComparison {
 public:
  explicit RaysComparison(const RaysOptions& options)
      : options_(options),
        names_(study_scene_names(options.scenes)),
        isas_(compared_isas(options.isas)),
        csv_(options.csv, rays_csv_columns(), {timing_remark(options.measure.round_count)}) {}

  void run() {
    fmt::print("{}", table_heading(columns_));
    for (const std::string& name : names_) measure_scene(load_study_scene(name, options_.scenes));
    fmt::print("{}", rays_summary(cells_));
  }

 private:
  void measure_scene(const StudyScene& scene) {
    const std::vector<Receiver> receivers = choose_tiles(scene, options_.tile_count);
    const OccluderBvh occluders(scene.mesh.view());
    const reference::EmbreeReference oracle(scene.mesh, {});
    for (const ComparedIsa& isa : isas_) {
      const char* const config = isa.embree_config.empty() ? nullptr : isa.embree_config.c_str();
      const reference::EmbreeScene rival(scene.mesh.view(), false, config);
      measure_isa({&occluders, &rival, &oracle, receivers}, scene, isa);
    }
  }

  void measure_isa(const CellInput& input, const StudyScene& scene, const ComparedIsa& isa) {
    for (const float radius : options_.radii.empty() ? compared_radii(scene) : lengths_of(options_.radii, scene)) {
      const char* const group = is_unbounded(radius, scene.mesh) ? kUnbounded : kBounded;
      for (const int ray_count : options_.ray_counts) {
        const bool with_scalar = isa.name == isas_.front().name;
        add(measure(input, options_.measure, {scene.name, radius, group, ray_count, isa, 0, {}}, with_scalar));
      }
    }
  }

  void add(const std::vector<Cell>& cells) {
    for (const Cell& cell : cells) {
      for (const Measurement& measurement : rays_measurements(cell)) csv_.write(measurement);
      fmt::print("{}", table_row(columns_, rays_table_measurement(cell)));
      cells_.push_back(cell);
    }
    std::fflush(stdout);
  }

  RaysOptions options_;
  std::vector<std::string> names_;
  std::vector<ComparedIsa> isas_;
  CsvFile csv_;
  const Columns columns_ = rays_table_columns();
  std::vector<Cell> cells_;
};

// In the order of the first of each: a cell measured twice would count twice.
template <typename Value>
void remove_repeats(std::vector<Value>& values) {
  std::vector<Value> kept;
  for (const Value& value : values) {
    if (std::find(kept.begin(), kept.end(), value) == kept.end()) kept.push_back(value);
  }
  values = std::move(kept);
}

void check(RaysOptions& options) {
  check_ray_counts(options.ray_counts);
  std::sort(options.measure.thread_counts.begin(), options.measure.thread_counts.end());
  remove_repeats(options.measure.thread_counts);
  remove_repeats(options.ray_counts);
  remove_repeats(options.radii);
  remove_repeats(options.isas);
  remove_repeats(options.scenes.names);
}

}  // namespace

Command add_rays_command(CLI::App& program) {
  auto options = std::make_shared<RaysOptions>();
  CLI::App* app = program.add_subcommand(
      "rays", "Millions of rays a second, lkao against Embree. One thread: by its CPU time; several: by wall time.");
  add_scene_options(*app, options->scenes);
  add_radii_option(
      *app, "--radius", options->radii,
      "AO radii: lengths, 5% of the scene's diagonal, or inf (default: each scene's own, and inf where none "
      "is beyond the scene)");
  add_ray_counts_option(*app, options->ray_counts);
  add_rounds_option(*app, options->measure.round_count);
  add_tiles_option(*app, options->tile_count);
  add_threads_option(*app, options->measure.thread_counts);
  add_isas_option(*app, options->isas);
  add_csv_option(*app, options->csv);
  return {app, [options] {
            check(*options);
            RaysComparison(*options).run();
            return 0;
          }};
}

}  // namespace lkao::bench
