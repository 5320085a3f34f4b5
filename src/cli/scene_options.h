// The scene on the command line: a mesh, and what is put around it.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace lkao::cli {

struct SceneOptions {
  std::string name;  // a mesh file, or builtin:NAME
  bool flip = false;
  bool opaque = false;  // triangles with holes by transparency are whole
  bool ground = false;
  std::vector<std::string> blockers = {};  // mesh files
  std::optional<int> uv_set = {};          // texture coordinates to read; set by who needs them
  bool own_object = false;                 // objects are read, and each is to be blocked by itself alone

  bool has_surroundings() const { return ground || !blockers.empty(); }
  // All that is read, files that a glTF names among it: names that are no files do no harm.
  std::vector<std::string> inputs() const;
};

// The argument SCENE alone.
void add_scene_argument(CLI::App& app, std::string& name);
// SCENE, --flip, --opaque, --ground and --blockers. `ground_help` says what becomes of the ground.
void add_scene_options(CLI::App& app, SceneOptions& options, const std::string& ground_help);

}  // namespace lkao::cli
