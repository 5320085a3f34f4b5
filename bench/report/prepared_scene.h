// What all questions about one scene share, each part made when it is first needed.
#pragma once

#include <map>
#include <optional>

#include "bench/study_scenes.h"
#include "method/occluders.h"
#include "reference/embree_reference.h"
#include "reference/embree_scene.h"

namespace lkao::bench {

class PreparedScene {
 public:
  // The scene must outlive this.
  explicit PreparedScene(const StudyScene& study_scene) : scene(study_scene), occluders(study_scene.mesh) {}

  // Robust Embree: what bits are compared with.
  const reference::EmbreeReference& oracle();
  // Embree at its full speed.
  const reference::EmbreeScene& rival();
  // The same scene and camera, with pictures divided by this each way; at least a pixel. Throws
  // std::runtime_error with one line where the camera sees nothing any more.
  const StudyScene& shrunk(int divisor);

  const StudyScene& scene;
  method::Occluders occluders;

 private:
  std::optional<reference::EmbreeReference> oracle_;
  std::optional<reference::EmbreeScene> rival_;
  std::map<int, StudyScene> shrunk_;
};

}  // namespace lkao::bench
