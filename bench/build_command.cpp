// lkao-bench build: hierarchies of lkao and scenes of Embree over the same meshes, their time and their memory, and how
// fast queries are with and without spatial splits.
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <CLI/CLI.hpp>

#include "build_cost.h"
#include "build_report.h"
#include "cli/median.h"
#include "commands.h"
#include "csv_file.h"
#include "options.h"
#include "scene/builtin.h"
#include "study_scenes.h"
#include "tree_quality.h"

namespace lkao::bench {
namespace {

struct Options {
  StudySceneOptions scenes;
  std::vector<std::size_t> hairballs;
  std::vector<int> thread_counts;
  std::vector<BuildMethod> methods = {kBuildMethods.begin(), kBuildMethods.end()};
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
  BuildResult result{method, cli::median(samples.build_seconds), cli::median(samples.cpu_seconds),
                     per_triangle(samples.last.memory_bytes), per_triangle(samples.last.mesh_bytes)};
  if (samples.last.occluders) result.quality = tree_quality(*samples.last.occluders);
  if (!samples.query_seconds.empty()) {
    result.query_microseconds = cli::median(samples.query_seconds) * 1e6 / static_cast<double>(input.receivers.size());
  }
  return result;
}

// Round after round, so that a slow moment of the machine meets all methods.
std::vector<BuildResult> measure(const Input& input, int thread_count, const Options& options) {
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

class Comparison {
 public:
  explicit Comparison(const Options& options) : options_(options), csv_(options.csv, build_csv_heading()) {}

  void run() {
    std::vector<std::string> names;
    if (options_.hairballs.empty() || !options_.scenes.names.empty()) names = study_scene_names(options_.scenes);
    fmt::print("{}", build_table_heading());
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
    fmt::print("{}", build_quality_heading());
    for (const BuildCell& cell : cells_) fmt::print("{}", build_quality_rows(cell));
    fmt::print("\n{}{}", build_summary(cells_), peak_memory());
  }

 private:
  void measure_scene(const std::string& name, const Input& input) {
    for (const int thread_count : options_.thread_counts) {
      BuildCell cell{name, input.mesh.triangles.size(), thread_count, measure(input, thread_count, options_)};
      fmt::print("{}", build_table_row(cell));
      std::fflush(stdout);
      csv_.write(build_csv_rows(cell));
      cells_.push_back(std::move(cell));
    }
  }

  Options options_;
  CsvFile csv_;
  std::vector<BuildCell> cells_;
};

// One, and all that there are.
std::vector<int> default_thread_counts() {
  const int all = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
  return all > 1 ? std::vector{1, all} : std::vector{1};
}

}  // namespace

Command add_build_command(CLI::App& program) {
  auto options = std::make_shared<Options>();
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
  std::map<std::string, BuildMethod> methods;
  for (const BuildMethod method : kBuildMethods) methods[name_of(method)] = method;
  app->add_option("--methods", options->methods,
                  "of lkao, lkao_no_splits, embree_high, embree_medium; one, for its peak memory")
      ->delimiter(',')
      ->transform(CLI::CheckedTransformer(methods));
  app->add_flag("--queries", options->queries,
                "also time queries in lkao's hierarchies: a view of 128 x 96 pixels, 128 rays, the largest radius");
  add_rounds_option(*app, options->round_count);
  add_csv_option(*app, options->csv);
  return {app, [options] { Comparison(*options).run(); }};
}

}  // namespace lkao::bench
