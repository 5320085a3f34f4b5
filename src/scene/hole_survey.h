// What is to be said of whole parts of triangles with holes: all clear, all opaque, or neither.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lkao/cut_outs.h"
#include "scene/holes.h"
#include "scene/texel_bounds.h"

namespace lkao::scene {

// A CutOutSurvey for Holes::blocks, cheap to copy.
class HoleSurvey {
 public:
  explicit HoleSurvey(std::shared_ptr<const Holes> holes);

  CutOutPart operator()(std::uint32_t triangle, float u0, float v0, float size) const;

 private:
  std::shared_ptr<const Holes> holes_;
  std::vector<std::shared_ptr<const TexelBounds>> images_;  // by material; null where it has none
};

// For CutOuts::looks: triangles with the same material, texture coordinates and alphas.
std::vector<std::uint32_t> looks_of(const Holes& holes);

}  // namespace lkao::scene
