#include "cli/camera_options.h"

#include "cli/options.h"
#include "cli/parse.h"
#include "cli/parsed_option.h"

namespace lkao::cli {
namespace {

scene::Camera default_camera(const CameraOptions& options, const SceneInput& scene, float aspect) {
  if (const scene::BuiltinScene* builtin = find_builtin(scene.name)) return builtin->camera;
  // Framing needs a sound up vector; where the one given is not, scene::validate() says so later.
  const scene::Camera plain;
  const glm::vec3 up = options.up && *options.up != glm::vec3(0) ? *options.up : plain.up;
  return scene::frame(scene::bounds_of(scene.mesh), aspect, up, options.fov.value_or(plain.fov));
}

}  // namespace

void add_camera_options(CLI::App& app, CameraOptions& options) {
  add_parsed(app, "--eye", options.eye, parse_position, "Where the camera is (default: where it sees the scene)")
      ->type_name("X,Y,Z");
  add_parsed(app, "--target", options.target, parse_position, "What it looks at (default: the middle)")
      ->type_name("X,Y,Z");
  add_parsed(app, "--up", options.up, parse_vector, "What is up in the image (default: 0,1,0)")->type_name("X,Y,Z");
  add_parsed(app, "--fov", options.fov, parse_field_of_view,
             "Horizontal field of view in degrees (default: the scene's own, or 60)")
      ->type_name("D");
}

scene::Camera choose_camera(const CameraOptions& options, const SceneInput& scene, float aspect) {
  scene::Camera camera = default_camera(options, scene, aspect);
  if (options.eye) camera.eye = glm::vec3(*options.eye - scene.mesh.origin);
  if (options.target) camera.target = glm::vec3(*options.target - scene.mesh.origin);
  camera.up = options.up.value_or(camera.up);
  camera.fov = options.fov.value_or(camera.fov);
  scene::validate(camera);
  return camera;
}

}  // namespace lkao::cli
