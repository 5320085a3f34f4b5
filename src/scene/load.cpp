#include "scene/load.h"

#include "scene/builtin.h"

namespace lkao::scene {

Mesh load(const std::string& scene) { return open(scene).mesh; }

MeshFile open(const std::string& scene, const ReadOptions& options) {
  const std::string prefix = "builtin:";
  if (scene.starts_with(prefix)) return {.mesh = make_builtin(scene.substr(prefix.size())), .contents = {}};
  return open_mesh_file(scene, options);
}

}  // namespace lkao::scene
