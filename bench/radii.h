// AO radii that are given for all scenes of a study.
#pragma once

#include <string>
#include <vector>

#include "bench/study_scenes.h"
#include "method/radius.h"

namespace CLI {
class App;
}

namespace lkao::bench {

// Several of them, with commas between: lengths of at most kMaxStudyRadius, shares as 5%, or inf.
void add_radii_option(CLI::App& app, const std::string& name, std::vector<method::Radius>& radii,
                      const std::string& help);

// In the scene's unit. Throws std::invalid_argument where a share of this scene is no usable length.
std::vector<float> lengths_of(const std::vector<method::Radius>& radii, const StudyScene& scene);

}  // namespace lkao::bench
