#include "method/occluders.h"

#include "method/stopwatch.h"

namespace lkao::method {

const std::vector<OccluderLevel>& Occluders::hierarchies() {
  if (hierarchies_.empty()) {
    const Stopwatch watch;
    hierarchies_ =
        chain_ != nullptr ? lod::build_levels(*chain_, radius_) : std::vector{OccluderLevel{OccluderBvh(mesh_.view())}};
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
