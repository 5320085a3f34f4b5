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
  std::vector<std::string> methods;  // families of contestants; empty: all
  bool is_quick = false;             // fewer contestants, one radius a scene, smaller pictures
  // Wall-clock time, that of earlier starts of the same report included; none: as long as it takes. What does not fit
  // in it is left out, what is slowest first, and told of. Where a frame's time was estimated wrongly, or a scene takes
  // minutes to load, it may be exceeded by that.
  std::optional<double> minutes = {};
  int round_count = 3;
  int turn_count = 3;  // of each half of the reference: thousands (1024) of rays
};

// Measures what the folder does not have yet, and returns everything there is to tell. Ctrl-C ends the program; what
// was measured stays. Throws std::exception with one line.
nlohmann::ordered_json measure_report(const ReportOptions& options);

// FOLDER/report.csv: a row for each contestant on each subject, those that were left out with no more than what they
// would take.
void write_report_csv(const std::string& folder, const nlohmann::ordered_json& report);

}  // namespace lkao::bench
