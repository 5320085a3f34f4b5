// Built-in scenes: deterministic, made by code, y up.
#pragma once

#include <string>
#include <vector>

#include "scene/mesh.h"

namespace lkao::scene {

struct BuiltinScene {
  std::string name;         // without "builtin:"
  std::string description;  // one line
};

// All of them, in the order they are listed to the user: atrium, city, hairball, and the small ones with known
// answers: plane, box, wall, disk, sphere.
const std::vector<BuiltinScene>& builtin_scenes();

// Throws std::runtime_error naming the unknown name and the known ones.
Mesh make_builtin(const std::string& name);

}  // namespace lkao::scene
