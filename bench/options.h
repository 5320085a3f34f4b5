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
// --threads: numbers, or "all" for as many as the machine has.
void add_threads_option(CLI::App& app, std::vector<int>& thread_counts);
// --csv
void add_csv_option(CLI::App& app, std::string& path);

}  // namespace lkao::bench
