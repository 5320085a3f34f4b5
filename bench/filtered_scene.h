// A mesh with holes in Embree, as a host has it that cares for speed: whole triangles and those with holes apart, and a
// filter for the latter alone, which asks the holes at Embree's own u and v.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "scene/embree.h"
#include "scene/holes.h"
#include "scene/mesh.h"

namespace lkao::bench {

class FilteredScene {
 public:
  // `config` as of rtcNewDevice; empty for Embree's defaults. The mesh must have holes and outlive it.
  FilteredScene(const scene::Mesh& mesh, const std::string& config);

  RTCScene scene() const { return scene_.get(); }

 private:
  // Of one of the two, by Embree's numbers: which of the mesh's triangles they are.
  struct Holed {
    std::shared_ptr<const scene::Holes> holes;
    std::vector<std::uint32_t> primitives;
  };

  static void filter(const RTCFilterFunctionNArguments* arguments);
  void attach(const scene::Mesh& mesh, const std::vector<std::uint32_t>& primitives, bool has_holes);

  scene::embree::Device device_;
  scene::embree::Scene scene_;
  std::unique_ptr<Holed> holed_;
};

}  // namespace lkao::bench
