// The camera of a rendering: what the user gave of it, and a sensible choice for the rest.
#pragma once

#include <optional>

#include <glm/vec3.hpp>

#include "cli/scene_input.h"
#include "scene/camera.h"

namespace CLI {
class App;
}

namespace lkao::cli {

struct CameraOptions {
  std::optional<glm::dvec3> eye;  // places are in the file's coordinates
  std::optional<glm::dvec3> target;
  std::optional<glm::vec3> up;
  std::optional<float> fov;  // horizontal, in degrees
};
void add_camera_options(CLI::App& app, CameraOptions& options);

// Less the mesh's origin, as the mesh is. What is not given comes from the built-in scene's own camera, or from one
// that sees the whole mesh. Throws std::invalid_argument where the result is no camera: eye equal to target, up zero or
// along the view.
scene::Camera choose_camera(const CameraOptions& options, const SceneInput& scene, float aspect);

}  // namespace lkao::cli
