#include "cli/scene_options.h"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "cli/gltf_output.h"
#include "scene/gltf_writer.h"
#include "scene/ground.h"

namespace lkao::cli {

namespace {

// The buffers and images of a glTF. What is wrong with it is said by who loads it.
std::vector<std::string> files_beside(const std::string& model) {
  if (!is_gltf(model)) return {};
  try {
    return scene::GltfFile(model, model).neighbours();
  } catch (const std::runtime_error&) {
    return {};
  }
}

}  // namespace

std::vector<std::string> SceneOptions::inputs() const {
  std::vector<std::string> inputs = blockers;
  inputs.push_back(name);
  const std::vector<std::string> models = inputs;
  for (const std::string& model : models) {
    for (std::string& file : files_beside(model)) inputs.push_back(std::move(file));
  }
  return inputs;
}

void add_scene_argument(CLI::App& app, std::string& name) {
  app.add_option("scene", name, "A mesh file (OBJ, PLY, STL, OFF, glTF, GLB) or builtin:NAME")
      ->required()
      ->type_name("SCENE");
}

void add_scene_options(CLI::App& app, SceneOptions& options, const std::string& ground_help) {
  add_scene_argument(app, options.name);
  app.add_flag("--flip", options.flip, "Turn the scene's triangles and normals round: for files that are inside out");
  app.add_flag("--opaque", options.opaque,
               "Take triangles with holes as whole. Otherwise a glTF's alphaMode MASK is obeyed: rays and cameras pass "
               "where alpha is below alphaCutoff. Of BLEND each ray is blocked with the probability alpha, and cameras "
               "see what is 0.5 or more; so of d, Tr and map_d of an OBJ's materials");
  app.add_flag("--ground", options.ground,
               fmt::format("Put a ground under the scene, square to --up, as wide as the radius needs ({:g} diagonals "
                           "of the scene's box around it where that is inf): it blocks, and {}",
                           scene::kGroundReach, ground_help));
  // One value an option, so that a scene behind it is not taken for another one.
  app.add_option("--blockers", options.blockers,
                 "A mesh file in the scene's coordinates that blocks and gets nothing: cameras look through it (may be "
                 "given several times)")
      ->type_name("FILE")
      ->allow_extra_args(false);
}

}  // namespace lkao::cli
