#include "method/occluders.h"

#include "method/stopwatch.h"
#include "scene/holes.h"

namespace lkao::method {

const std::vector<OccluderLevel>& Occluders::hierarchies() {
  if (hierarchies_.empty()) {
    const Stopwatch watch;
    if (chain_ != nullptr) {
      hierarchies_ = lod::build_levels(*chain_, radius_);
    } else {
      hierarchies_ = {{OccluderBvh(mesh_.view(), {.cut_outs = scene::cut_outs_of(mesh_.holes)})}};
    }
    build_seconds_ = watch.seconds();
  }
  return hierarchies_;
}

const scene::Mesh& Occluders::drawn_mesh() { return chain_ != nullptr ? merged().mesh : mesh_; }

std::span<const glm::vec2> Occluders::drawn_ranges() {
  if (chain_ == nullptr) return {};
  return merged().ranges;
}

const lod::RangedMesh& Occluders::merged() {
  if (!merged_) merged_ = lod::merge(*chain_, radius_);
  return *merged_;
}

}  // namespace lkao::method
