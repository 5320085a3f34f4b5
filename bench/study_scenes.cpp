#include "bench/study_scenes.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "scene/builtin.h"
#include "scene/camera.h"
#include "scene/load.h"

namespace lkao::bench {
namespace {

using nlohmann::json;

glm::dvec3 vector_of(const json& value) { return {value.at(0), value.at(1), value.at(2)}; }

StudyScene load_builtin(const std::string& name, const StudySceneOptions& options) {
  const scene::BuiltinScene& builtin = scene::builtin_scene(name);
  return look_at(name, scene::make_builtin(name), {builtin.radii.small, builtin.radii.large}, builtin.camera,
                 options.width, options.height);
}

std::filesystem::path mesh_path(const json& view, const StudySceneOptions& options) {
  std::filesystem::path folder = options.meshes;
  if (folder.empty()) folder = std::filesystem::path(options.views).parent_path();
  return folder / view.at("file").get<std::string>();
}

scene::Mesh load_mesh(const json& view, const StudySceneOptions& options) {
  return scene::load(mesh_path(view, options).string());
}

// Files and radii of a scene; cameras are looked at when the mesh is there.
void check_view(const json& view, const StudySceneOptions& options) {
  const std::string path = mesh_path(view, options).string();
  if (!std::ifstream(path)) throw std::runtime_error(fmt::format("{}: cannot be read", path));
  const auto radii = view.at("radii").get<std::vector<float>>();
  const std::string name = view.at("name");
  if (radii.empty()) throw std::runtime_error(fmt::format("{}: {} has no radii", options.views, name));
  for (const float radius : radii) {
    if (radius > 0 && radius <= kMaxStudyRadius) continue;
    throw std::runtime_error(fmt::format("{}: radii of {} must be above 0 and at most {:g}, not {:g}", options.views,
                                         name, kMaxStudyRadius, radius));
  }
}

StudyScene load_view(const json& view, const StudySceneOptions& options) {
  scene::Mesh mesh = load_mesh(view, options);
  // Cameras are in the file's coordinates.
  const scene::Camera camera{glm::vec3(vector_of(view.at("eye")) - mesh.origin),
                             glm::vec3(vector_of(view.at("target")) - mesh.origin), glm::vec3(vector_of(view.at("up"))),
                             view.at("fov")};
  return look_at(view.at("name"), std::move(mesh), view.at("radii"), camera, options.width, options.height);
}

// Calls `read` with the list of scenes in the file.
template <typename Read>
auto read_views(const std::string& path, const Read& read) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(fmt::format("{}: cannot be read", path));
  try {
    return read(json::parse(file).at("scenes"));
  } catch (const json::exception& error) {
    throw std::runtime_error(fmt::format("{}: {}", path, error.what()));
  }
}

std::vector<std::string> names_in(const json& views) {
  std::vector<std::string> names;
  for (const json& view : views) names.push_back(view.at("name"));
  return names;
}

// The scenes that are asked for by name, all of them where none is.
std::vector<std::string> chosen_names(const json& views, const StudySceneOptions& options) {
  const std::vector<std::string> known = names_in(views);
  for (const std::string& name : options.names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw std::runtime_error(fmt::format("{}: has no scene '{}'", options.views, name));
  }
  if (known.empty()) throw std::runtime_error(fmt::format("{}: has no scenes", options.views));
  return options.names.empty() ? known : options.names;
}

const json& view_of(const std::string& name, const json& views) {
  return *std::find_if(views.begin(), views.end(), [&](const json& view) { return view.at("name") == name; });
}

std::vector<StudyScene> load_views(const StudySceneOptions& options) {
  return read_views(options.views, [&](const json& views) {
    std::vector<StudyScene> scenes;
    for (const std::string& name : chosen_names(views, options)) {
      scenes.push_back(load_view(view_of(name, views), options));
    }
    return scenes;
  });
}

}  // namespace

StudyScene look_at(std::string name, scene::Mesh mesh, std::vector<float> radii, const scene::Camera& camera, int width,
                   int height) {
  scene::ReceiverImage view = scene::find_receivers(mesh, camera, width, height);
  if (view.receiver_count == 0) throw std::runtime_error(fmt::format("{}: the camera sees nothing", name));
  std::vector<Receiver> receivers = scene::seen_receivers(view);
  return {std::move(name), std::move(mesh), std::move(radii), camera, std::move(view), std::move(receivers)};
}

std::vector<std::string> study_scene_names(const StudySceneOptions& options) {
  if (!options.views.empty()) {
    return read_views(options.views, [&](const json& views) {
      const std::vector<std::string> names = chosen_names(views, options);
      for (const std::string& name : names) check_view(view_of(name, views), options);
      return names;
    });
  }
  if (options.names.empty()) return {"atrium", "city"};
  for (const std::string& name : options.names) scene::builtin_scene(name);  // throws where there is none
  return options.names;
}

scene::Mesh load_study_mesh(const std::string& name, const StudySceneOptions& options) {
  if (options.views.empty()) return scene::make_builtin(name);
  return read_views(options.views, [&](const json& views) { return load_mesh(view_of(name, views), options); });
}

std::vector<StudyScene> load_study_scenes(const StudySceneOptions& options) {
  if (!options.views.empty()) return load_views(options);
  std::vector<StudyScene> scenes;
  for (const std::string& name : study_scene_names(options)) scenes.push_back(load_builtin(name, options));
  return scenes;
}

StudyScene load_study_scene(const std::string& name, const StudySceneOptions& options) {
  StudySceneOptions one = options;
  one.names = {name};
  return std::move(load_study_scenes(one).front());
}

}  // namespace lkao::bench
