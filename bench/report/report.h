// Speed against error, over all methods: what is measured, and the files that tell of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/study_scenes.h"

namespace lkao::bench {

struct ReportOptions {
  std::string folder;
  StudySceneOptions scenes = {.views = {}, .meshes = {}, .names = {}, .width = 320, .height = 240};
  std::vector<std::string> families;  // of contestants; empty: all
  bool is_quick = false;              // fewer contestants, one radius a scene, smaller pictures
  int round_count = 3;
  int turn_count = 3;  // of each half of the reference: thousands (1024) of rays
};

// Measures what the folder does not have yet. Returns everything there is to tell; none where Ctrl-C stopped it: what
// was measured stays. Throws std::exception with one line.
std::optional<nlohmann::ordered_json> measure_report(const ReportOptions& options);

// FOLDER/report.csv: a row for each contestant on each subject.
void write_report_csv(const std::string& folder, const nlohmann::ordered_json& report);

}  // namespace lkao::bench
