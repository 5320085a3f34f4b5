// The scene of a run: loaded, rid of bad triangles, and what was found on the way.
#pragma once

#include <optional>
#include <string>

#include "scene/builtin.h"
#include "scene/defects.h"
#include "scene/mesh.h"
#include "scene/radius.h"

namespace lkao::cli {

struct SceneInput {
  std::string name;  // as the user gave it
  scene::Mesh mesh;  // of usable triangles only
  scene::Defects defects;
  double load_seconds = 0;
};

// Loads a scene and drops the triangles that cannot block anything. Throws std::runtime_error with one line where
// that fails or leaves no triangle.
SceneInput load_scene(const std::string& name);

// What is known of a built-in scene; nullptr for a file.
const scene::BuiltinScene* find_builtin(const std::string& name);

// A built-in scene's own radii, or what suits the bounds.
scene::SuggestedRadii suggest_radii(const std::string& name, const Bounds& bounds);

// Throws std::invalid_argument with suggestions that suit the scene where no radius was given.
void require_radius(const std::optional<double>& radius, const SceneInput& scene);

// A line on stderr for each kind of triangle that was dropped.
void report_dropped_triangles(const SceneInput& scene);

}  // namespace lkao::cli
