#include "bench/report/prepared_scene.h"

#include <algorithm>

namespace lkao::bench {

const reference::EmbreeReference& PreparedScene::oracle() {
  if (!oracle_) oracle_.emplace(scene.mesh);
  return *oracle_;
}

const reference::EmbreeScene& PreparedScene::rival() {
  if (!rival_) rival_.emplace(scene.mesh.view(), false);
  return *rival_;
}

const StudyScene& PreparedScene::shrunk(int divisor) {
  const auto found = shrunk_.find(divisor);
  if (found != shrunk_.end()) return found->second;
  const int width = std::max(1, scene.view.width / divisor), height = std::max(1, scene.view.height / divisor);
  return shrunk_.emplace(divisor, look_at(scene.name, scene.mesh, scene.radii, scene.camera, width, height))
      .first->second;
}

}  // namespace lkao::bench
