// Scenes that a study runs on: a mesh, what a camera sees of it, and AO radii.
#pragma once

#include <string>
#include <vector>

#include "lkao/lkao.h"
#include "scene/camera.h"
#include "scene/mesh.h"

namespace lkao::bench {

// The longest AO radius that is not infinite.
inline constexpr float kMaxStudyRadius = 1e18f;

struct StudyScene {
  std::string name;
  scene::Mesh mesh;
  std::vector<float> radii;
  scene::Camera camera;
  scene::ReceiverImage view;
  std::vector<Receiver> receivers;  // of the view's pixels that see a triangle
};

// Throws std::runtime_error with one line where the camera sees nothing.
StudyScene look_at(std::string name, scene::Mesh mesh, std::vector<float> radii, const scene::Camera& camera, int width,
                   int height);

// What to load, and how many pixels wide and high the receivers' image is.
struct StudySceneOptions {
  // A file like views.json of the shared scenes: mesh files relative to it, cameras, radii. Empty: built-in scenes.
  std::string views;
  std::string meshes;              // the folder of its mesh files; empty: the file's own
  std::vector<std::string> names;  // empty: all of the file, or atrium and city
  int width = 32;
  int height = 24;
};

// Throws std::runtime_error or std::invalid_argument with one line that names the file or scene and the fault.
std::vector<StudyScene> load_study_scenes(const StudySceneOptions& options);

// One of them alone: for programs that hold one scene at a time. Errors as above.
StudyScene load_study_scene(const std::string& name, const StudySceneOptions& options);

// The mesh alone of one of them. Errors as above.
scene::Mesh load_study_mesh(const std::string& name, const StudySceneOptions& options);

// What load_study_scenes loads, by name. Errors as above, also those of radii and missing files: hours before a study
// gets to them.
std::vector<std::string> study_scene_names(const StudySceneOptions& options);

}  // namespace lkao::bench
