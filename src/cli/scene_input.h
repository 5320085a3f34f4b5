// The scene of a run: loaded, rid of bad triangles, with what surrounds it, and what was found on the way.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/scene_options.h"
#include "method/radius.h"
#include "scene/builtin.h"
#include "scene/defects.h"
#include "scene/mesh.h"
#include "scene/mesh_file.h"
#include "scene/radius.h"

namespace lkao::cli {

struct SceneInput {
  std::string name;          // as the user gave it
  scene::Mesh mesh;          // the scene itself, of usable triangles only
  scene::Contents contents;  // of its file
  scene::Defects defects;    // likewise
  bool opaque = false;       // what is loaded beside it has no holes either
  double load_seconds = 0;
  std::vector<std::string> notes;  // a line each

  // What surrounds the scene, each together with all that is before it; none where it was not asked for.
  std::optional<scene::Mesh> with_ground;
  std::optional<scene::Mesh> with_blockers;

  // What cameras see: the scene and its ground.
  const scene::Mesh& seen() const { return with_ground ? *with_ground : mesh; }
  // What blocks: that and the blockers.
  const scene::Mesh& occluders() const { return with_blockers ? *with_blockers : seen(); }
};

// Loads a scene and drops the triangles that cannot block anything. Throws std::runtime_error with one line where
// that fails or leaves no triangle.
SceneInput load_scene(const SceneOptions& options);

// Another mesh file with the scene's origin, without bad triangles; what is to be said of it joins the scene's notes.
scene::Mesh load_beside(const std::string& file, SceneInput& scene);

// Adds the ground, for an AO radius of this length, and loads the blockers. Throws as load_scene does, and
// std::invalid_argument where `up` is zero.
void add_surroundings(SceneInput& scene, const SceneOptions& options, const glm::vec3& up, double radius);

// What is known of a built-in scene; nullptr for a file.
const scene::BuiltinScene* find_builtin(const std::string& name);

// A built-in scene's own radii, or what suits the bounds.
scene::SuggestedRadii suggest_radii(const std::string& name, const Bounds& bounds);

// In the scene's unit. Throws std::invalid_argument where no radius was given, with suggestions that suit the scene,
// and where a share of its size is no usable radius.
double resolve_radius(const std::optional<method::Radius>& radius, const SceneInput& scene);

// A line each: that the origin is not zero, and what the file says that is not obeyed.
std::vector<std::string> notes_on(const std::string& name, const scene::MeshFile& file);
// On stderr.
void print_notes(const std::vector<std::string>& notes);

}  // namespace lkao::cli
