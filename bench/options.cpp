#include "bench/options.h"

#include <stdexcept>

#include <fmt/format.h>
#include <tbb/info.h>
#include <CLI/CLI.hpp>

#include "lkao/sample_pattern.h"

namespace lkao::bench {

void add_scene_options(CLI::App& app, StudySceneOptions& scenes, const std::string& built_in) {
  app.add_option("--views", scenes.views, "scenes of this views.json instead of built-in ones");
  app.add_option("--meshes", scenes.meshes, "folder of the mesh files (default: that of views.json)");
  app.add_option("--scenes", scenes.names, "names of scenes (default: all; built in: " + built_in + ")")
      ->delimiter(',');
}

void add_size_options(CLI::App& app, StudySceneOptions& scenes) {
  app.add_option("--width", scenes.width, "of the view, in pixels")->check(CLI::Range(1, 16384))->capture_default_str();
  app.add_option("--height", scenes.height, "of the view")->check(CLI::Range(1, 16384))->capture_default_str();
}

void add_rounds_option(CLI::App& app, int& round_count) {
  app.add_option("--rounds", round_count, "of which the median counts")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
}

void add_ray_counts_option(CLI::App& app, std::vector<int>& ray_counts) {
  app.add_option("--samples", ray_counts, "rays a receiver")->delimiter(',')->capture_default_str();
}

void check_ray_counts(const std::vector<int>& ray_counts) {
  for (const int ray_count : ray_counts) {
    if (is_valid_ray_count(ray_count)) continue;
    throw std::invalid_argument(
        fmt::format("--samples must be from {} to {}, not {}", kMinRayCount, kMaxRayCount, ray_count));
  }
}

void add_tiles_option(CLI::App& app, int& tile_count) {
  app.add_option("--tiles", tile_count, "32 x 32 pixels each, of the view at 1024 x 768")
      ->check(CLI::Range(1, 768))
      ->capture_default_str();
}

void add_isas_option(CLI::App& app, std::vector<std::string>& isas) {
  app.add_option("--isa", isas,
                 "instruction sets of both sides, each in turn (default: those of avx512, avx2, sse4 that there are)")
      ->delimiter(',');
}

void add_threads_option(CLI::App& app, std::vector<int>& thread_counts) {
  const auto number_of = [](const std::string& text) {
    return text == "all" ? std::to_string(tbb::info::default_concurrency()) : text;
  };
  app.add_option("--threads", thread_counts, "each in turn: numbers, or all")
      ->delimiter(',')
      ->transform(number_of, "")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
}

void add_csv_option(CLI::App& app, std::string& path) {
  app.add_option("--csv", path, "write every measurement to this file");
}

}  // namespace lkao::bench
