// --normals, on `render` and `bake`.
#pragma once

#include <optional>

#include "cli/scene_input.h"
#include "method/words.h"
#include "scene/corner_normals.h"

namespace CLI {
class App;
}

namespace lkao::cli {

inline constexpr method::Word<scene::NormalSource> kNormalSourceWords[] = {{"file", scene::NormalSource::file},
                                                                           {"smooth", scene::NormalSource::smooth},
                                                                           {"facet", scene::NormalSource::facet}};

void add_normals_option(CLI::App& app, std::optional<scene::NormalSource>& source);

// What was asked for, or what suits the scene. Throws std::invalid_argument with one line where the scene has no
// normals of the file to use.
scene::NormalSource choose_normals(const std::optional<scene::NormalSource>& source, const SceneInput& scene);

}  // namespace lkao::cli
