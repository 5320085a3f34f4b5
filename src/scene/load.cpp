#include "scene/load.h"

#include "scene/builtin.h"
#include "scene/mesh_file.h"

namespace lkao::scene {

Mesh load(const std::string& scene) {
  const std::string prefix = "builtin:";
  if (scene.starts_with(prefix)) return make_builtin(scene.substr(prefix.size()));
  return read_mesh_file(scene);
}

}  // namespace lkao::scene
