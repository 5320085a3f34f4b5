// Options that several subcommands have.
#pragma once

#include <string>
#include <vector>

#include "bench/study_scenes.h"

namespace CLI {
class App;
}

namespace lkao::bench {

// --views, --scenes. `built_in`: the scenes without either, for the help.
void add_scene_options(CLI::App& app, StudySceneOptions& scenes, const std::string& built_in = "atrium, city");
// --width, --height
void add_size_options(CLI::App& app, StudySceneOptions& scenes);
// --rounds
void add_rounds_option(CLI::App& app, int& round_count);
// --samples, of which check_ray_counts throws std::invalid_argument with one line where one is out of range.
void add_ray_counts_option(CLI::App& app, std::vector<int>& ray_counts);
void check_ray_counts(const std::vector<int>& ray_counts);
// --tiles, of views of 1024 x 768 pixels
void add_tiles_option(CLI::App& app, int& tile_count);
// --isa
void add_isas_option(CLI::App& app, std::vector<std::string>& isas);
// --threads: numbers, or "all" for as many as the machine has.
void add_threads_option(CLI::App& app, std::vector<int>& thread_counts);
// --csv
void add_csv_option(CLI::App& app, std::string& path);

}  // namespace lkao::bench
