// lkao-bench build: hierarchies of lkao and scenes of Embree over the same meshes, their time and their memory, and how
// fast queries are with and without spatial splits.
#include <sys/resource.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <CLI/CLI.hpp>

#include "bench/build_cost.h"
#include "bench/build_report.h"
#include "bench/commands.h"
#include "bench/csv_file.h"
#include "bench/options.h"
#include "bench/study_scenes.h"
#include "bench/tree_quality.h"
#include "bench/word_option.h"
#include "method/median.h"
#include "scene/builtin.h"

namespace lkao::bench {
namespace {

struct BuildOptions {
  StudySceneOptions scenes;
  std::vector<std::size_t> hairballs;
  std::vector<int> thread_counts;
  std::vector<BuildMethod> methods = {BuildMethod::lkao, BuildMethod::lkao_no_splits, BuildMethod::embree_high,
                                      BuildMethod::embree_medium};
  int round_count = 5;
  bool queries = false;
  std::string csv;
};

// What is built over, and what then is asked of it: no receivers: nothing.
struct Input {
  const TriangleMesh mesh;
  std::span<const Receiver> receivers;
  float radius;
};

struct Samples {
  std::vector<double> build_seconds, cpu_seconds, query_seconds;
  BuildCost last = {};
};

void run_once(BuildMethod method, const Input& input, Samples& samples) {
  samples.last.occluders.reset();  // not two at a time
  samples.last = build_once(method, input.mesh);
  samples.build_seconds.push_back(samples.last.seconds);
  samples.cpu_seconds.push_back(samples.last.cpu_seconds);
  if (!samples.last.occluders || input.receivers.empty()) return;
  samples.query_seconds.push_back(query_cpu_seconds(*samples.last.occluders, input.receivers, input.radius));
}

BuildResult result_of(BuildMethod method, const Input& input, const Samples& samples) {
  const auto per_triangle = [&](std::size_t bytes) {
    return static_cast<double>(bytes) / static_cast<double>(std::max<std::size_t>(input.mesh.triangles.size(), 1));
  };
  BuildResult result{method, method::median(samples.build_seconds), method::median(samples.cpu_seconds),
                     per_triangle(samples.last.memory_bytes), per_triangle(samples.last.mesh_bytes)};
  if (samples.last.occluders) result.quality = tree_quality(*samples.last.occluders);
  if (!samples.query_seconds.empty()) {
    result.query_microseconds =
        method::median(samples.query_seconds) * 1e6 / static_cast<double>(input.receivers.size());
  }
  return result;
}

// Round after round, so that a slow moment of the machine meets all methods.
std::vector<BuildResult> measure(const Input& input, int thread_count, const BuildOptions& options) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(thread_count));
  std::vector<Samples> samples(options.methods.size());
  tbb::task_arena(thread_count).execute([&] {
    for (int round = 0; round < options.round_count; ++round) {
      for (std::size_t i = 0; i < samples.size(); ++i) run_once(options.methods[i], input, samples[i]);
    }
  });
  std::vector<BuildResult> results;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    results.push_back(result_of(options.methods[i], input, samples[i]));
  }
  return results;
}

std::string peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return fmt::format("Peak memory of this process, with the mesh: {} MiB\n", usage.ru_maxrss / 1024);
}

class BuildComparison {
 public:
  explicit BuildComparison(const BuildOptions& options) : options_(options), csv_(options.csv, build_csv_columns()) {}

  void run() {
    std::vector<std::string> names;
    if (options_.hairballs.empty() || !options_.scenes.names.empty()) names = study_scene_names(options_.scenes);
    fmt::print("{}", table_heading(columns_));
    for (const std::string& name : names) {
      if (options_.queries) {
        const StudyScene scene = load_study_scene(name, options_.scenes);
        measure_scene(name, {scene.mesh.view(), scene.receivers, scene.radii.back()});
      } else {
        const scene::Mesh mesh = load_study_mesh(name, options_.scenes);
        measure_scene(name, {mesh.view(), {}, 0});
      }
    }
    for (const std::size_t count : options_.hairballs) {
      const scene::Mesh mesh = scene::make_hairball(count);
      measure_scene("hairball", {mesh.view(), {}, 0});
    }
    print_quality();
    fmt::print("\n{}{}", build_summary(cells_), peak_memory());
  }

 private:
  void measure_scene(const std::string& name, const Input& input) {
    for (const int thread_count : options_.thread_counts) {
      BuildCell cell{name, input.mesh.triangles.size(), thread_count, measure(input, thread_count, options_)};
      fmt::print("{}", table_row(columns_, build_table_measurement(cell)));
      std::fflush(stdout);
      for (const Measurement& measurement : build_measurements(cell)) csv_.write(measurement);
      cells_.push_back(std::move(cell));
    }
  }

  void print_quality() const {
    const Columns columns = build_quality_columns();
    fmt::print("\n{}", table_heading(columns));
    for (const BuildCell& cell : cells_) {
      const std::vector<Measurement> measurements = build_measurements(cell);
      for (std::size_t i = 0; i < measurements.size(); ++i) {
        if (cell.results[i].quality) fmt::print("{}", table_row(columns, measurements[i]));
      }
    }
  }

  BuildOptions options_;
  CsvFile csv_;
  const Columns columns_ = build_table_columns(options_.methods);
  std::vector<BuildCell> cells_;
};

// One, and all that there are.
std::vector<int> default_thread_counts() {
  const int all = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
  return all > 1 ? std::vector{1, all} : std::vector{1};
}

}  // namespace

Command add_build_command(CLI::App& program) {
  auto options = std::make_shared<BuildOptions>();
  options->scenes.width = 128, options->scenes.height = 96;
  options->thread_counts = default_thread_counts();
  CLI::App* app =
      program.add_subcommand("build", "Time, memory and quality of hierarchies, lkao against Embree's scenes.");
  add_scene_options(*app, options->scenes);
  app->add_option("--hairball", options->hairballs,
                  "also, or alone without --scenes: the built-in hairball with this many triangles")
      ->delimiter(',')
      ->check(CLI::Range(1, 1'000'000'000));
  app->add_option("--threads", options->thread_counts, "each in turn (default: 1 and all)")
      ->delimiter(',')
      ->check(CLI::Range(1, 1024));
  add_words_option(*app, "--methods", options->methods, kBuildMethodWords, "some of them; one, for its peak memory");
  app->add_flag("--queries", options->queries,
                "also time queries in lkao's hierarchies: a view of 128 x 96 pixels, 128 rays, the largest radius");
  add_rounds_option(*app, options->round_count);
  add_csv_option(*app, options->csv);
  return {app, [options] {
            BuildComparison(*options).run();
            return 0;
          }};
}

}  // namespace lkao::bench
