#include "scene/builtin.h"

#include <algorithm>
#include <stdexcept>

namespace lkao::scene {

const std::vector<BuiltinScene>& builtin_scenes() {
  static const std::vector<BuiltinScene> kScenes = {
      {"atrium",
       "a vaulted hall with columns, niches and steps",
       {{-13.4f, 2.5f, 1.5f}, {2.0f, 3.9f, -0.9f}, {0, 1, 0}, 80},
       {0.5f, 2.0f}},
      {"city",
       "blocks of buildings with windows, trees and lamps",
       {{-250, 190, 395}, {30, 20, -60}, {0, 1, 0}, 60},
       {75, 225}},
      {"hairball", "thin tubes wound around a core", {{4.5f, 4.5f, 11}, {0, 0, 0}, {0, 1, 0}, 52}, {0.1f, 0.3f}},
      {"plane", "an open plane: occlusion 0", {{0, 4, 8}, {0, 0, 0}, {0, 1, 0}, 60}, {0.5f, 2}},
      {"box",
       "a closed box seen from inside: occlusion 1",
       {{-0.8f, 1.2f, 0.8f}, {0.5f, 0.6f, -0.5f}, {0, 1, 0}, 80},
       {0.5f, 4}},
      {"wall", "a wall on a floor: occlusion 1/2 at its foot", {{3, 3, 7}, {0, 1, 0}, {0, 1, 0}, 60}, {0.5f, 2}},
      {"disk",
       "a disk above a floor: occlusion 1/2 below its centre",
       {{3, 2.5f, 5}, {0, 0.5f, 0}, {0, 1, 0}, 60},
       {0.5f, 2}},
      {"sphere",
       "a sphere above a floor: occlusion 1/4 below its centre",
       {{3, 3, 6}, {0, 1, 0}, {0, 1, 0}, 60},
       {0.5f, 2}},
  };
  return kScenes;
}

const BuiltinScene& builtin_scene(const std::string& name) {
  const std::vector<BuiltinScene>& scenes = builtin_scenes();
  const auto found =
      std::find_if(scenes.begin(), scenes.end(), [&name](const BuiltinScene& scene) { return scene.name == name; });
  if (found != scenes.end()) return *found;
  std::string known;
  for (const BuiltinScene& scene : scenes) known += " " + scene.name;
  throw std::runtime_error("builtin:" + name + ": there is no such built-in scene (known:" + known + ")");
}

Mesh make_builtin(const std::string& name) {
  constexpr std::size_t kHairballTriangleCount = 2'880'000;
  const std::string& known_name = builtin_scene(name).name;
  if (known_name == "atrium") return make_atrium();
  if (known_name == "city") return make_city();
  if (known_name == "hairball") return make_hairball(kHairballTriangleCount);
  if (known_name == "plane") return make_plane();
  if (known_name == "box") return make_box();
  if (known_name == "wall") return make_wall();
  if (known_name == "disk") return make_disk();
  return make_sphere();
}

}  // namespace lkao::scene
