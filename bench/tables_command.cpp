// lkao-bench tables: what a plane mask table gets wrong, and what it costs, by resolution, ray count and addressing.
// Nearest cells are compared with the exact query ray by ray; exact tables must agree with it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "bench/commands.h"
#include "bench/csv_file.h"
#include "bench/options.h"
#include "bench/plane_errors.h"
#include "bench/study_scenes.h"
#include "bench/table_report.h"
#include "bench/table_words.h"
#include "bench/word_option.h"
#include "lkao/lkao.h"
#include "method/answers.h"
#include "method/speed.h"

namespace lkao::bench {
namespace {

struct TablesOptions {
  StudySceneOptions scenes;
  std::vector<int> resolutions = {32, 64, 128, 256};
  std::vector<int> ray_counts = {64, 128, 256, 512, 1024};
  std::vector<PlaneAddressing> addressings = {PlaneAddressing::cube, PlaneAddressing::slices};
  std::vector<PlaneMasks> masks = {PlaneMasks::nearest, PlaneMasks::must_may};
  std::vector<NodeMasks> node_masks = {NodeMasks::bounding_sphere, NodeMasks::box_outline};
  std::string falloff = "constant";
  double max_mib = 1024;
  int plane_count = 10'000;
  int round_count = 1;
  std::string csv;
};

// A scene at one radius, and its exact answers for the pattern in use.
struct Case {
  const StudyScene* scene;
  OccluderBvh occluders;
  float radius;
  method::Answers exact;    // of the scalar kernel
  double simd_seconds = 0;  // of the other exact kernel
};

std::vector<Case> make_cases(const std::vector<StudyScene>& scenes) {
  std::vector<Case> cases;
  for (const StudyScene& scene : scenes) {
    const OccluderBvh occluders(scene.mesh.view());
    for (const float radius : scene.radii) cases.push_back({&scene, occluders, radius, {}, 0});
  }
  return cases;
}

TableResult measure(const Case& c, const PlaneMaskTable& table, NodeMasks node_masks, int round_count) {
  const AmbientOcclusion ao(c.occluders, table, {.radius = c.radius}, node_masks);
  const method::Answers answers = method::ask(ao, c.scene->receivers, round_count);
  const method::Deviation off = deviation(answers, c.exact);
  const auto receiver_count = static_cast<double>(c.scene->receivers.size());
  return {static_cast<double>(off.wrong_ray_count.value()) / receiver_count, off.error, answers.ray_count,
          answers.seconds};
}

double expected_mib(const SamplePattern& pattern, const PlaneMaskTableOptions& options) {
  const auto lengths = pattern.lengths();
  const bool has_full_length = std::all_of(lengths.begin(), lengths.end(), [](float l) { return l == 1; });
  return std::pow(options.resolution, 3) * pattern.ray_count() / 8 / 0x1p20 *
         (options.masks == PlaneMasks::must_may ? 2 : 1) * (has_full_length ? 1 : 2);
}

class Study {
 public:
  explicit Study(const TablesOptions& options)
      : options_(options),
        csv_(options.csv, tables_csv_columns()),
        scenes_(load_study_scenes(options.scenes)),
        cases_(make_cases(scenes_)) {}

  // False where an exact table was found to be wrong.
  bool run() {
    fmt::print(
        "Rays in error (nearest) or in doubt (exact) of each edge, plane and triangle; wrong rays of each\n"
        "receiver, errors and speed as means over the scenes.\n\n{}",
        table_heading(columns_));
    for (const int ray_count : options_.ray_counts) study_ray_count(ray_count);
    if (has_exact_ && wrong_exact_rays_ == 0) fmt::print("\nexact masks: no ray differs from the exact kernel\n");
    if (wrong_exact_rays_ > 0) {
      fmt::print("\nexact masks: RAYS DIFFER from the exact kernel, or lie outside the bounds\n");
    }
    return wrong_exact_rays_ == 0;
  }

 private:
  void study_ray_count(int ray_count) {
    const SamplePattern pattern = SamplePattern::standard(ray_count).with_falloff(Falloff::named(options_.falloff));
    const PlaneSamples samples(pattern, options_.plane_count, 1);
    ask_exactly(pattern);
    for (const int resolution : options_.resolutions) {
      for (const PlaneMasks masks : options_.masks) {
        for (const PlaneAddressing addressing : options_.addressings) {
          study_table(pattern, samples, {resolution, addressing, masks});
        }
      }
    }
  }

  void ask_exactly(const SamplePattern& pattern) {
    std::uint64_t ray_count = 0;
    double scalar_seconds = 0, simd_seconds = 0;
    for (Case& c : cases_) {
      const auto ask_kernel = [&](Kernel kernel) {
        const AmbientOcclusion ao(c.occluders, pattern, {.radius = c.radius}, kernel);
        return method::ask(ao, c.scene->receivers, options_.round_count);
      };
      c.exact = ask_kernel(Kernel::scalar);
      c.simd_seconds = ask_kernel(Kernel::simd).seconds;
      ray_count += c.exact.ray_count;
      scalar_seconds += c.exact.seconds;
      simd_seconds += c.simd_seconds;
    }
    fmt::print("{:5} rays, exact kernels without a table: scalar {:.2f}, SIMD {:.2f} Mrays/s\n", pattern.ray_count(),
               method::mrays_per_second(ray_count, scalar_seconds), method::mrays_per_second(ray_count, simd_seconds));
  }

  void study_table(const SamplePattern& pattern, const PlaneSamples& samples, const PlaneMaskTableOptions& options) {
    if (const double mib = expected_mib(pattern, options); mib > options_.max_mib) {
      fmt::print("{:5} {:5} {:7} {:8} left out: {:.0f} MiB are above --max-mib {:.0f}\n", pattern.ray_count(),
                 options.resolution, word_of(kAddressingWords, options.addressing),
                 word_of(method::kPlaneMaskWords, options.masks), mib, options_.max_mib);
      return;
    }
    const PlaneMaskTable table(pattern, options);
    const PlaneErrors planes = samples.errors(table);
    for (const NodeMasks node_masks : options_.node_masks) study_node_masks(table, planes, node_masks);
  }

  void study_node_masks(const PlaneMaskTable& table, const PlaneErrors& planes, NodeMasks node_masks) {
    std::vector<TableResult> results;
    for (const Case& c : cases_) {
      results.push_back(measure(c, table, node_masks, options_.round_count));
      write(c, table_measurement(table, node_masks, planes, results.back()));
    }
    const TableResult all = mean(results);
    fmt::print("{}", table_row(columns_, table_measurement(table, node_masks, planes, all)));
    std::fflush(stdout);
    if (table.options().masks != PlaneMasks::must_may) return;
    has_exact_ = true;
    wrong_exact_rays_ += all.wrong_rays + planes.edge.wrong + planes.plane.wrong + planes.triangle.wrong;
  }

  void write(const Case& c, Measurement measurement) {
    measurement.emplace_back("scene", c.scene->name);
    measurement.emplace_back("radius", c.radius);
    measurement.emplace_back("receivers", c.scene->receivers.size());
    measurement.emplace_back("scalar_mrays_per_second", method::mrays_per_second(c.exact.ray_count, c.exact.seconds));
    measurement.emplace_back("simd_mrays_per_second", method::mrays_per_second(c.exact.ray_count, c.simd_seconds));
    csv_.write(measurement);
  }

  TablesOptions options_;
  CsvFile csv_;
  std::vector<StudyScene> scenes_;
  std::vector<Case> cases_;
  const Columns columns_ = tables_table_columns();
  bool has_exact_ = false;
  double wrong_exact_rays_ = 0;
};

}  // namespace

Command add_tables_command(CLI::App& program) {
  auto options = std::make_shared<TablesOptions>();
  CLI::App* app = program.add_subcommand("tables", "Error, size and speed of plane mask tables.");
  add_scene_options(*app, options->scenes);
  add_size_options(*app, options->scenes);
  app->add_option("--resolutions", options->resolutions)->delimiter(',')->capture_default_str();
  app->add_option("--rays", options->ray_counts)->delimiter(',')->capture_default_str();
  add_words_option(*app, "--addressings", options->addressings, kAddressingWords);
  add_words_option(*app, "--masks", options->masks, method::kPlaneMaskWords);
  add_words_option(*app, "--node-masks", options->node_masks, kNodeMaskWords);
  app->add_option("--falloff", options->falloff, "of the ray lengths")->capture_default_str();
  app->add_option("--max-mib", options->max_mib, "leave larger tables out")->capture_default_str();
  app->add_option("--planes", options->plane_count, "random planes and triangles")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  add_rounds_option(*app, options->round_count);
  add_csv_option(*app, options->csv);
  return {app, [options] { return Study(*options).run() ? 0 : 1; }};
}

}  // namespace lkao::bench
