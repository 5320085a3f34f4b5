// What the parts of a query are measured on.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/study_scenes.h"
#include "bvh/layout.h"
#include "bvh/query.h"
#include "lkao/lkao.h"
#include "reference/embree_reference.h"

namespace lkao::bench {

struct MeasuredScene {
  explicit MeasuredScene(StudyScene scene);

  StudyScene view;
  std::vector<Receiver> tiles;  // two dense tiles of the view's receivers
  OccluderBvh occluders;
  reference::EmbreeReference oracle;
};

// A built-in scene, or "closed": a wavy closed surface of 260 K triangles seen from outside. Made at the first call and
// kept.
const MeasuredScene& measured_scene(const std::string& name);

// Of a batch of receivers.
struct Accuracy {
  double ray_count;
  double mismatch_rate;  // share of the rays whose answer differs from robust Embree's
};
Accuracy find_accuracy(const MeasuredScene& scene, const AmbientOcclusion& ao, const std::vector<Receiver>& receivers);

// What one receiver in the atrium has around it.
struct Surroundings {
  // So few that they stay in the first-level cache.
  static constexpr std::size_t kCount = 64;

  OccluderBvh occluders;
  float radius;
  ReceiverRays rays;              // 128
  std::vector<bvh::Node> nodes;   // with all children
  std::vector<bvh::Leaf> leaves;  // with all triangles

  bvh::Query query() const { return {occluders.layout().roots(), rays, rays.cast, radius}; }
};

// kCount nodes and leaves, evenly of all that some ray may meet. Made at the first call and kept.
const Surroundings& surroundings();

}  // namespace lkao::bench
